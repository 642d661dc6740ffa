// SPDX-License-Identifier: LGPL-2.1-or-later
// Reduction of relations by orbits.

#include <npt_dealii/homogenization/orbit_constraints.h>

#include <cmath>
#include <stdexcept>

namespace NPT
{
  OrbitConstraints::OrbitConstraints(const unsigned int n_unknowns,
                                     const Affine      &unit)
    : n_macro_(unit.size())
    , unit_(unit)
    , fixed_(n_unknowns, false)
    , value_(n_unknowns)
  {
    for (unsigned int i = 0; i < n_unknowns; ++i)
      parent_.push_back({i, 1., Affine(n_macro_, 0.)});
  }



  OrbitConstraints::Representation
  OrbitConstraints::representation(const unsigned int i) const
  {
    // Follow the chain to its root, composing signs and affine parts, and
    // shorten it.
    if (parent_[i].root != i)
      {
        const Representation up = representation(parent_[i].root);
        if (parent_[i].root != up.root)
          {
            for (unsigned int k = 0; k < n_macro_; ++k)
              parent_[i].affine[k] += parent_[i].sign * up.affine[k];
            parent_[i].sign *= up.sign;
            parent_[i].root = up.root;
          }
      }
    return parent_[i];
  }



  void
  OrbitConstraints::relate(const unsigned int i,
                           const double       sign,
                           const unsigned int j,
                           const Affine      &affine,
                           const std::string &name)
  {
    AssertIndexRange(i, parent_.size());
    AssertDimension(affine.size(), n_macro_);
    AssertIndexRange(j, parent_.size());
    const Representation ri = representation(i), rj = representation(j);

    // s_i X_i + a_i = sign (s_j X_j + a_j) + affine.
    Affine difference(n_macro_); // everything known, moved to the right
    for (unsigned int k = 0; k < n_macro_; ++k)
      difference[k] = sign * rj.affine[k] + affine[k] - ri.affine[k];

    const auto check = [&](const Affine &a, const Affine &b) {
      for (unsigned int k = 0; k < n_macro_; ++k)
        if (std::abs(a[k] - b[k]) > 1e-9 * (unit_[k] + std::abs(a[k])))
          throw std::logic_error(
            "The coupling '" + name +
            "' contradicts the others: it would prescribe macro unknown " +
            std::to_string(k) + ".");
    };
    const auto fix = [&](const unsigned int root, const Affine &value) {
      if (fixed_[root])
        check(value_[root], value);
      fixed_[root] = true;
      value_[root] = value;
    };

    if (ri.root == rj.root)
      {
        const double factor = ri.sign - sign * rj.sign;
        if (factor == 0.)
          check(difference, Affine(n_macro_, 0.));
        else
          {
            Affine value(n_macro_);
            for (unsigned int k = 0; k < n_macro_; ++k)
              value[k] = difference[k] / factor;
            fix(ri.root, value);
          }
        return;
      }

    // X_i = s_i (sign s_j X_j + difference): hang i's root under j's.
    Representation link{rj.root, ri.sign * sign * rj.sign, difference};
    for (double &value : link.affine)
      value *= ri.sign;
    const bool   was_fixed = fixed_[ri.root];
    const Affine old_value = value_[ri.root];
    parent_[ri.root]       = link;
    if (was_fixed)
      {
        Affine value(n_macro_);
        for (unsigned int k = 0; k < n_macro_; ++k)
          value[k] = (old_value[k] - link.affine[k]) / link.sign;
        fix(rj.root, value);
      }
  }



  void
  OrbitConstraints::combine(const unsigned int       i,
                            const std::vector<Term> &terms,
                            const Affine            &affine,
                            const std::string       &name)
  {
    AssertIndexRange(i, parent_.size());
    AssertDimension(affine.size(), n_macro_);
    combinations_.push_back({i, terms, affine, name});
  }



  OrbitConstraints::Form
  OrbitConstraints::right_side(const Combination &combination,
                               Reduction         &reduction) const
  {
    Form form{{}, combination.affine};
    for (const Term &term : combination.terms)
      {
        const Form x = reduced(term.j, reduction);
        for (const auto &[root, factor] : x.free)
          form.free[root] += term.factor * factor;
        for (unsigned int k = 0; k < n_macro_; ++k)
          form.affine[k] += term.factor * x.affine[k];
      }
    return form;
  }



  OrbitConstraints::Form
  OrbitConstraints::reduced_root(const unsigned int root,
                                 Reduction         &reduction) const
  {
    if (fixed_[root])
      return {{}, value_[root]};
    const auto found = reduction.combination_of.find(root);
    if (found == reduction.combination_of.end())
      return {{{root, 1.}}, Affine(n_macro_, 0.)};
    const auto done = reduction.done.find(root);
    if (done != reduction.done.end())
      return done->second;

    // x_i = s X + a = right side.
    const Combination &combination = combinations_[found->second];
    if (reduction.begun[root])
      throw std::logic_error("The condition '" + combination.name +
                             "' defines an unknown by itself.");
    reduction.begun[root]     = true;
    const Representation r    = representation(combination.i);
    Form                 form = right_side(combination, reduction);
    for (auto &entry : form.free)
      entry.second *= r.sign;
    for (unsigned int k = 0; k < n_macro_; ++k)
      form.affine[k] = r.sign * (form.affine[k] - r.affine[k]);
    reduction.done[root] = form;
    return form;
  }



  OrbitConstraints::Form
  OrbitConstraints::reduced(const unsigned int i, Reduction &reduction) const
  {
    const Representation r    = representation(i);
    Form                 form = reduced_root(r.root, reduction);
    for (auto &entry : form.free)
      entry.second *= r.sign;
    for (unsigned int k = 0; k < n_macro_; ++k)
      form.affine[k] = r.sign * form.affine[k] + r.affine[k];
    return form;
  }



  void
  OrbitConstraints::write(dealii::AffineConstraints<double> &constraints) const
  {
    Reduction reduction;
    for (unsigned int c = 0; c < combinations_.size(); ++c)
      {
        const unsigned int root = representation(combinations_[c].i).root;
        if (!fixed_[root])
          reduction.combination_of.emplace(root, c); // the first one stays
      }
    for (const Combination &combination : combinations_)
      {
        const Form left  = reduced(combination.i, reduction);
        Form       right = right_side(combination, reduction);
        for (const auto &[root, factor] : left.free)
          right.free[root] -= factor;
        for (const auto &entry : right.free)
          if (std::abs(entry.second) > 1e-9)
            throw std::logic_error("The condition '" + combination.name +
                                   "' contradicts the others: it would "
                                   "restrict unknown " +
                                   std::to_string(entry.first) + ".");
        for (unsigned int k = 0; k < n_macro_; ++k)
          if (std::abs(right.affine[k] - left.affine[k]) >
              1e-9 * (unit_[k] + std::abs(left.affine[k])))
            throw std::logic_error("The condition '" + combination.name +
                                   "' contradicts the others: it would "
                                   "prescribe macro unknown " +
                                   std::to_string(k) + ".");
      }

    for (unsigned int i = 0; i < parent_.size(); ++i)
      {
        const unsigned int root = representation(i).root;
        if (root == i && !fixed_[i] && reduction.combination_of.count(i) == 0)
          continue;
        const Form form = reduced(i, reduction);
        constraints.add_line(i);
        for (const auto &[free, factor] : form.free)
          if (std::abs(factor) > 1e-14)
            constraints.add_entry(i, free, factor);
        for (unsigned int k = 0; k < n_macro_; ++k)
          if (std::abs(form.affine[k]) > 1e-14 * unit_[k])
            constraints.add_entry(i, parent_.size() + k, form.affine[k]);
      }
  }
} // namespace NPT
