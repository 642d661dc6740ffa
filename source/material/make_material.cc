// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the material subsection of a parameter file: the choice of the law
// and the entries of all laws.

#include <npt_dealii/base/declared_parameters.h>
#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/message_words.h>
#include <npt_dealii/base/parameter_binding.h>
#include <npt_dealii/material/make_material.h>

namespace NPT
{
  namespace
  {
    const Registry<RegisteredLaw> &
    laws()
    {
      return Registry<RegisteredLaw>::instance();
    }

    std::string
    descriptions()
    {
      std::vector<std::string> result;
      for (const std::string &name : laws().names())
        result.push_back(laws().get(name).description);
      return joined(result, ", or ");
    }
  } // namespace



  MaterialParameters::MaterialParameters(const std::string &given_law)
    : law(given_law)
  {
    for (const std::string &name : laws().names())
      constants_[name] = laws().get(name).make_parameters();
  }



  MaterialParameters::MaterialParameters(const MaterialParameters &other)
  {
    *this = other;
  }



  MaterialParameters &
  MaterialParameters::operator=(const MaterialParameters &other)
  {
    if (this == &other)
      return *this;
    law = other.law;
    constants_.clear();
    for (const auto &[name, constants] : other.constants_)
      constants_[name] = constants->clone();
    return *this;
  }



  const LawParameters &
  MaterialParameters::selected_constants() const
  {
    laws().get(law); // throws with the nearest name
    return *constants_.at(law);
  }



  void
  MaterialParameters::add_parameters(dealii::ParameterHandler &prm,
                                     const std::string        &subsection,
                                     const std::string        &same_as)
  {
    const std::string same = same_as.empty() ? "" : "as " + same_as;

    const ParameterSubsection scope(prm, subsection);
    add_parameter(prm,
                  "Law",
                  law,
                  "Strain energy: " + descriptions() +
                    (same.empty() ? "." :
                                    "; or law and constants " + same +
                                      ". Constants not given here have "
                                      "their defaults, not those of the " +
                                      same_as + "."),
                  dealii::Patterns::Selection((same.empty() ? "" : same + "|") +
                                              laws().selection()));
    for (auto &item : constants_)
      item.second->add_parameters(prm);
  }



  std::string
  MaterialParameters::first_changed_constant() const
  {
    MaterialParameters       defaults, changed(*this);
    dealii::ParameterHandler of_defaults, of_changed;
    changed.law = defaults.law;
    defaults.add_parameters(of_defaults, "Material");
    changed.add_parameters(of_changed, "Material");

    const auto before = declared_parameters(of_defaults).subsections[0];
    const auto now    = declared_parameters(of_changed).subsections[0];
    for (std::size_t i = 0; i < now.entries.size(); ++i)
      if (now.entries[i].value != before.entries[i].value)
        return now.entries[i].name;
    return "";
  }



  void
  MaterialParameters::check(const std::string        &subsection,
                            const MaterialParameters *other)
  {
    if (other != nullptr && law.compare(0, 3, "as ") == 0)
      {
        const std::string ignored = first_changed_constant();
        if (!ignored.empty())
          throw InputError(ignored + " is given, but Law is " + law +
                           ", which ignores it; choose Law = " +
                           joined(laws().names(), " or ") +
                           ", or remove the entry (subsection " + subsection +
                           ").");
        *this = *other;
        return;
      }
    selected_constants().check(subsection);
  }
} // namespace NPT
