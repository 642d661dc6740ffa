// SPDX-License-Identifier: LGPL-2.1-or-later
// Relations between displacements and handles.

#include <npt_dealii/verification/contact/handle_couplings.h>

namespace NPT
{
  using dealii::Point;

  HandleCouplings::HandleCouplings(const IGASpace<3> &space)
    : space_(space)
  {}



  void
  HandleCouplings::tie(const unsigned int unknown, const Terms &terms)
  {
    if (constraints_.is_constrained(unknown))
      return;
    constraints_.add_line(unknown);
    for (const auto &term : terms)
      if (term.second != 0.)
        constraints_.add_entry(unknown, term.first, term.second);
  }



  std::vector<unsigned int>
  HandleCouplings::face(const unsigned int patch,
                        const unsigned int direction,
                        const unsigned int side) const
  {
    const NURBSPatch<3>      &p = space_.patch(patch);
    std::vector<unsigned int> result;
    const unsigned int        layer =
      side == 0 ? 0 : p.n_control_points(direction) - 1;
    for (unsigned int A = 0; A < p.n_control_points(); ++A)
      if (p.multi_index(A)[direction] == layer)
        result.push_back(space_.control_point(patch, A));
    return result;
  }



  std::vector<unsigned int>
  HandleCouplings::all(const unsigned int patch) const
  {
    std::vector<unsigned int> result;
    for (unsigned int A = 0; A < space_.patch(patch).n_control_points(); ++A)
      result.push_back(space_.control_point(patch, A));
    return result;
  }



  const dealii::AffineConstraints<double> &
  HandleCouplings::close()
  {
    constraints_.close();
    return constraints_;
  }



  void
  hold(HandleCouplings                 &couplings,
       const std::vector<unsigned int> &points,
       const std::vector<unsigned int> &components)
  {
    for (const unsigned int A : points)
      for (const unsigned int c : components)
        couplings.tie(couplings.displacement(A, c));
  }



  void
  attach(HandleCouplings                 &couplings,
         const std::vector<unsigned int> &points,
         const unsigned int               component,
         const unsigned int               handle)
  {
    for (const unsigned int A : points)
      couplings.tie(couplings.displacement(A, component),
                    {{couplings.handle(handle), 1.}});
  }



  void
  attach_rotation(HandleCouplings                 &couplings,
                  const std::vector<unsigned int> &points,
                  const unsigned int               cosine,
                  const unsigned int               sine)
  {
    const unsigned int c = couplings.handle(cosine), s = couplings.handle(sine);
    for (const unsigned int A : points)
      {
        const Point<3> &X = couplings.space().control_points()[A];
        couplings.tie(couplings.displacement(A, 0), {{c, X[0]}, {s, -X[1]}});
        couplings.tie(couplings.displacement(A, 1), {{s, X[0]}, {c, X[1]}});
      }
  }



  void
  plane_strain(HandleCouplings &couplings)
  {
    const IGASpace<3> &space = couplings.space();
    for (unsigned int patch = 0; patch < space.n_patches(); ++patch)
      {
        const NURBSPatch<3> &p = space.patch(patch);
        for (unsigned int a = 0; a < p.n_control_points(); ++a)
          {
            const unsigned int A = space.control_point(patch, a);
            couplings.tie(couplings.displacement(A, 1));
            auto index = p.multi_index(a);
            if (index[1] == 0)
              continue;
            index[1]             = 0;
            const unsigned int B = space.control_point(patch, p.index(index));
            for (const unsigned int c : {0, 2})
              couplings.tie(couplings.displacement(A, c),
                            {{couplings.displacement(B, c), 1.}});
          }
      }
  }
} // namespace NPT
