// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the problem `identification`: its parameters, its run, and the report
// of a fit.

#ifndef npt_dealii_problems_identification_identification_run_h
#define npt_dealii_problems_identification_identification_run_h

#include <npt_dealii/base/parameter_file.h>
#include <npt_dealii/io/run_log.h>
#include <npt_dealii/problems/identification/identification.h>

#include <deal.II/base/parameter_handler.h>

#include <ostream>
#include <string>
#include <vector>

namespace NPT
{
  /// Subsection "Output" of an identification and of a material test.
  struct MaterialOutputParameters
  {
    std::string directory;
    bool        fields  = false;
    bool        picture = true;

    /// Bind the members to the entries of the subsection.
    void
    add_parameters(dealii::ParameterHandler &prm, const bool with_fields);
  };

  /// A fit of tabulated data, `set Problem = identification`.
  struct IdentificationRunParameters
  {
    std::vector<std::string> files = {"output-nmt/material_tests.csv"};
    IdentificationParameters identification;
    MaterialOutputParameters output = {"output-identify"};

    std::string used_file;

    void
    add_parameters(dealii::ParameterHandler &prm);

    static IdentificationRunParameters
    read(const ParameterText            &text,
         const std::vector<std::string> &overrides = {});
    static std::string
    documented_defaults();

    /// The curves of all files. Throws InputError if a table cannot be used, or
    /// two curves have one name.
    std::vector<MaterialCurve>
    read_curves() const;
  };

  /// Say what was found in the log, and write the material file, fit.csv and
  /// the picture unless the directory is empty.
  void
  report_fit(const IdentificationResult       &result,
             const std::vector<MaterialCurve> &curves,
             const IdentificationParameters   &parameters,
             const std::string                &directory,
             const bool                        picture,
             RunLog                           &log);

  /// The problem `identification`: fit the curves that were read, write the
  /// material file, fit.csv and the picture.
  IdentificationResult
  run_identification(const IdentificationRunParameters &parameters,
                     const std::vector<MaterialCurve>  &curves,
                     const std::string                 &directory,
                     std::ostream                      &screen);
} // namespace NPT

#endif
