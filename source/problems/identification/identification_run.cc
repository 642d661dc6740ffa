// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the problem `identification`: from tables of tests to the constants
// of the bundle law.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/parameter_binding.h>
#include <npt_dealii/base/problem.h>
#include <npt_dealii/base/problem_names.h>
#include <npt_dealii/base/short_number.h>
#include <npt_dealii/io/output_folder.h>
#include <npt_dealii/io/replace_file.h>
#include <npt_dealii/problems/identification/identification_report.h>
#include <npt_dealii/problems/identification/identification_run.h>

#include <iostream>

namespace NPT
{
  namespace Patterns = dealii::Patterns;

  void
  MaterialOutputParameters::add_parameters(dealii::ParameterHandler &prm,
                                           const bool with_fields)
  {
    const ParameterSubsection subsection(prm, "Output");
    add_parameter(prm,
                  "Directory",
                  directory,
                  "Where all results go; created if missing. The option "
                  "--output of the program overrides it.",
                  Patterns::DirectoryName());
    if (with_fields)
      add_parameter(prm,
                    "Fields",
                    fields,
                    "Write the deformed cell and its stresses (VTU) at the "
                    "end of every test.");
    add_parameter(prm,
                  "Picture",
                  picture,
                  "Draw fit.svg, fit against test, with gnuplot.");
  }



  void
  IdentificationRunParameters::add_parameters(dealii::ParameterHandler &prm)
  {
    declare_problem(prm, "identification");
    {
      const ParameterSubsection subsection(prm, "Data");
      add_parameter(prm,
                    "Files",
                    files,
                    "Tables of tests (CSV with a header), separated by "
                    "commas: columns H11 ... H33 [-] and P11 ... P33 "
                    "[MPa], and optionally `test`, the name of the curve. "
                    "Missing H are zero, missing P were not measured; "
                    "direction 1 is the fiber's.",
                    Patterns::List(Patterns::Anything(), 1));
    }
    identification.add_parameters(prm);
    output.add_parameters(prm, false);
  }



  IdentificationRunParameters
  IdentificationRunParameters::read(const ParameterText            &text,
                                    const std::vector<std::string> &overrides)
  {
    IdentificationRunParameters parameters;
    dealii::ParameterHandler    prm;
    parameters.add_parameters(prm);
    parse_parameter_text(prm, text, overrides);
    parameters.used_file = documented_parameters(prm);
    return parameters;
  }



  std::string
  IdentificationRunParameters::documented_defaults()
  {
    return read({}).used_file;
  }



  void
  report_fit(const IdentificationResult       &result,
             const std::vector<MaterialCurve> &curves,
             const IdentificationParameters   &parameters,
             const std::string                &directory,
             const bool                        picture,
             RunLog                           &log)
  {
    for (const std::string &line : describe(result))
      log.line(line);
    std::string published = "Table 1 (sign of d corrected) on these curves, "
                            "rms error [%]:";
    for (const auto &error :
         curve_errors(curves, parameters, FiberBundleConstants()))
      published +=
        " " + error.name + " " + short_number(100. * error.rms, 3) + ";";
    published.back() = '.';
    log.line(published);
    if (directory.empty())
      return;
    write_material_file(directory + "/bundle_material.prm", result);
    const std::string warning =
      write_fit(directory, curves, result.constants, picture);
    if (!warning.empty())
      log.warning(warning);
    log.line("Written: " + directory + "/bundle_material.prm");
  }



  std::vector<MaterialCurve>
  IdentificationRunParameters::read_curves() const
  {
    std::vector<MaterialCurve> curves;
    for (const std::string &file : files)
      for (MaterialCurve &curve : read_material_curves(file))
        {
          for (const MaterialCurve &other : curves)
            if (other.name == curve.name)
              throw InputError("The curve '" + curve.name + "' of " + file +
                               " exists already; give every curve a name of "
                               "its own (entry Files, subsection Data).");
          curves.push_back(curve);
        }
    return curves;
  }



  IdentificationResult
  run_identification(const IdentificationRunParameters &parameters,
                     const std::vector<MaterialCurve>  &curves,
                     const std::string                 &directory,
                     std::ostream                      &screen)
  {
    RunLog log(RunLog::in_folder(directory, screen));
    if (!directory.empty())
      replace_file(directory + "/used_parameters.prm",
                   [&](std::ostream &out) { out << parameters.used_file; });
    log.header("Identification of the fiber bundle law (50)-(53)",
               {{"curves", std::to_string(curves.size())}});
    const IdentificationResult result =
      identify(curves, parameters.identification);
    report_fit(result,
               curves,
               parameters.identification,
               directory,
               parameters.output.picture,
               log);
    return result;
  }



  namespace
  {
    void
    start(const ParameterText &text, const CommandLine &command)
    {
      const auto parameters =
        IdentificationRunParameters::read(text, command.overrides);
      if (done_with_parameters(command, parameters))
        return;
      // Before the results of an earlier run are removed.
      const auto        curves = parameters.read_curves();
      const std::string directory =
        make_output_directory(command, parameters.output.directory);
      const OutputFolder folder(directory);
      run_identification(parameters, curves, directory, std::cout);
    }

    const Registry<Problem>::Registration
      registration("identification",
                   {2,
                    "identification of a bundle law from test data",
                    start,
                    false,
                    false,
                    false});
  } // namespace
} // namespace NPT
