// SPDX-License-Identifier: LGPL-2.1-or-later
// Report, material file, and picture of an identification.

#include <npt_dealii/io/gnuplot.h>
#include <npt_dealii/io/replace_file.h>
#include <npt_dealii/io/table_file.h>
#include <npt_dealii/problems/identification/identification_report.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <sstream>

namespace NPT
{
  using dealii::Tensor;

  std::vector<std::string>
  describe(const IdentificationResult &result)
  {
    std::vector<std::string> lines;
    const auto               add = [&](const std::ostringstream &text) {
      lines.push_back(text.str());
    };
    std::ostringstream head;
    head << "constant      value [MPa]   standard error   95 % interval (+-)";
    add(head);
    const std::vector<double> theta = bundle_constant_values(result.constants);
    for (unsigned int k = 0; k < theta.size(); ++k)
      {
        std::ostringstream text;
        text << std::left << std::setw(12) << bundle_constant_names()[k]
             << std::right << std::setprecision(6) << std::setw(13) << theta[k]
             << std::setprecision(3) << std::setw(17)
             << result.standard_error[k] << std::setw(20)
             << result.confidence[k];
        add(text);
      }
    std::ostringstream title;
    title << "curve             largest stress [MPa]   rms error [%]   "
             "largest error [%]";
    add(title);
    for (const auto &error : result.errors)
      {
        std::ostringstream text;
        text << std::left << std::setw(18) << error.name << std::right
             << std::setprecision(4) << std::setw(20) << error.scale
             << std::setprecision(3) << std::setw(16) << 100. * error.rms
             << std::setw(20) << 100. * error.largest;
        add(text);
      }
    const EngineeringConstants m = result.constants.engineering_constants();
    std::ostringstream         moduli;
    moduli << std::setprecision(4) << "small strain: E_L = " << m.E_L
           << ", E_T = " << m.E_T << ", G_L = " << m.G_L << ", G_T = " << m.G_T
           << " MPa, nu_LT = " << m.nu_LT;
    add(moduli);
    std::ostringstream stability;
    stability << std::setprecision(4)
              << "lowest eigenvalue of the stiffness at rest: "
              << result.stiffness.value << " MPa (" << result.stiffness.mode
              << ")";
    add(stability);
    std::ostringstream acoustic;
    acoustic << std::setprecision(4)
             << "lowest eigenvalue of the acoustic tensor over the fitted "
                "range: "
             << result.acoustic << " MPa (" << result.acoustic_place << ")";
    add(acoustic);
    std::ostringstream data;
    data << std::setprecision(2) << result.n_data
         << " stress values; reciprocal condition "
         << result.reciprocal_condition;
    add(data);
    for (const std::string &note : result.notes)
      lines.push_back("Note: " + note);
    return lines;
  }



  void
  write_material_file(const std::string          &filename,
                      const IdentificationResult &result)
  {
    replace_file(filename, [&](std::ostream &out) {
      out << "# Constants of the fiber bundle law (50)-(53), identified from\n"
             "# tests. Use: `include "
          << std::filesystem::path(filename).filename().string()
          << "` in another parameter file.\n#\n";
      for (const std::string &line : describe(result))
        out << "# " << line << '\n';
      out << "\nsubsection Fiber bundle material\n"
          << "  set Law        = fiber bundle\n"
          << std::setprecision(15);
      const std::vector<double> theta =
        bundle_constant_values(result.constants);
      for (unsigned int k = 0; k < theta.size(); ++k)
        out << "  set " << std::left << std::setw(10)
            << bundle_constant_names()[k] << " = " << theta[k] << '\n';
      out << "end\n";
    });
  }



  namespace
  {
    // The component of H that is driven most.
    unsigned int
    leading_component(const MaterialCurve &curve)
    {
      unsigned int best = 0;
      double       most = 0;
      for (const auto &H : curve.H)
        for (unsigned int e = 0; e < 9; ++e)
          if (std::abs(H[e / 3][e % 3]) > most + 1e-12)
            {
              most = std::abs(H[e / 3][e % 3]);
              best = e;
            }
      return best;
    }

    // A symmetric shear counts as engineering shear.
    double
    amplitude(const Tensor<2, 3> &H, const unsigned int e)
    {
      const unsigned int i = e / 3, J = e % 3;
      return i == J ? H[i][i] : H[i][J] + H[J][i];
    }

    double
    mean_stress(const Tensor<2, 3> &P, const unsigned int e)
    {
      return 0.5 * (P[e / 3][e % 3] + P[e % 3][e / 3]);
    }



    void
    write_fit_table(const std::string                &filename,
                    const std::vector<MaterialCurve> &curves,
                    const FiberBundleConstants       &constants)
    {
      std::vector<std::string> columns{"test", "amplitude", "stress", "fit"};
      for (const std::string kind : {"H", "P", "fit P"})
        for (unsigned int e = 0; e < 9; ++e)
          columns.push_back(kind + std::to_string(e / 3 + 1) +
                            std::to_string(e % 3 + 1));
      TableWriter table(filename,
                        columns,
                        {"Fit of the fiber bundle law to test data; stresses "
                         "in MPa, first Piola-Kirchhoff.",
                         "amplitude and stress: the component that is driven "
                         "most, engineering shear and mean of iJ and Ji."});
      for (const MaterialCurve &curve : curves)
        {
          const unsigned int e = leading_component(curve);
          for (unsigned int r = 0; r < curve.H.size(); ++r)
            {
              const Tensor<2, 3>     P = bundle_stress(constants, curve.H[r]);
              std::vector<TableCell> row{curve.name,
                                         amplitude(curve.H[r], e),
                                         mean_stress(curve.P[r], e),
                                         mean_stress(P, e)};
              for (const auto &T : {curve.H[r], curve.P[r], P})
                for (unsigned int k = 0; k < 9; ++k)
                  row.emplace_back(T[k / 3][k % 3]);
              table.add_row(row);
            }
        }
    }



    // Points and line of the tests of one kind, as in Fig. 8.
    void
    write_fit_panel(std::ostream                     &out,
                    const std::vector<MaterialCurve> &curves,
                    const bool                        shear)
    {
      out << "  set title '" << (shear ? "shear" : "tension") << "'\n";
      std::string  separator = "  plot \\\n";
      unsigned int n         = 0;
      for (const MaterialCurve &curve : curves)
        {
          const unsigned int e = leading_component(curve);
          if ((e / 3 != e % 3) != shear)
            continue;
          const std::string color = gnuplot_color(n++);
          std::string       name  = curve.name;
          for (char &c : name)
            if (c == '\'')
              c = ' ';
          for (const std::string kind : {"stress", "fit"})
            {
              out << separator << "    'fit.csv' using (column('amplitude')"
                  << "):(strcol('test') eq '" << name << "' ? column('" << kind
                  << "') : NaN) "
                  << (kind == "fit" ?
                        "with lines lw 2 lc rgb '" + color + "' notitle" :
                        "with points pt 7 ps 0.6 lc rgb '" + color +
                          "' title '" + name + "'");
              separator = ", \\\n";
            }
        }
      out << (n > 0 ? "\n" : "  set multiplot next\n");
    }
  } // namespace



  std::string
  write_fit(const std::string                &directory,
            const std::vector<MaterialCurve> &curves,
            const FiberBundleConstants       &constants,
            const bool                        picture)
  {
    write_fit_table(directory + "/fit.csv", curves, constants);

    GnuplotPicture frame;
    frame.name               = "fit";
    frame.width              = 1040;
    frame.height             = 420;
    frame.n_columns          = 2;
    frame.settings           = "set key left top reverse Left samplen 2\n"
                               "set xlabel 'H (shear: H_{iJ} + H_{Ji}) [-]'\n"
                               "set ylabel 'first Piola-Kirchhoff stress [MPa]'\n";
    const std::string script = directory + "/fit.gp";
    write_gnuplot_script(script, frame, [&](std::ostream &out) {
      for (const bool shear : {false, true})
        write_fit_panel(out, curves, shear);
    });
    return picture ? run_gnuplot(script) : std::string();
  }
} // namespace NPT
