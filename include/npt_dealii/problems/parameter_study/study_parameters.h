// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the parameters of a study: what to do, and all its cases, checked.

#ifndef npt_dealii_problems_parameter_study_study_parameters_h
#define npt_dealii_problems_parameter_study_study_parameters_h

#include <npt_dealii/base/parameter_binding.h>
#include <npt_dealii/base/parameter_file.h>
#include <npt_dealii/problems/parameter_study/parameter_loops.h>
#include <npt_dealii/problems/parameter_study/sweep.h>
#include <npt_dealii/problems/plate_results/stage_starts.h>

#include <deal.II/base/parameter_handler.h>

#include <memory>
#include <set>
#include <string>
#include <vector>

namespace NPT
{
  /**
   * Parameters of `set Problem = parameter study`: subsection Study says what
   * to do; all other entries are those of a plate test, with loops in their
   * values where they are swept (see ParameterLoops), and are added to the
   * file that the entry Base names.
   */
  struct StudyParameters
  {
    enum class Kind
    {
      sweep,          ///< the curves of all cases
      work_precision, ///< error against CPU time
      stability_map,  ///< success, iterations and cuts over two entries
      sensitivity     ///< which inputs matter over their ranges
    };

    Kind        kind = Kind::sweep;
    std::string title;
    std::string directory = "output-study";

    unsigned int side_by_side = 0;   ///< 0: as many as there are cores
    double       cpu_limit    = 600; ///< [s]
    bool         repeat       = false;

    std::string              x_column; ///< empty: of the last stage's target
    std::vector<std::string> y_columns;
    std::string              stage; ///< empty: the last one
    std::vector<std::string> panels, axes;
    std::vector<std::string> series          = {"automatic"};
    std::vector<double>      accuracies      = {0.1, 0.01, 0.001};
    unsigned int             mean_iterations = 0;
    unsigned int             rows            = 64; ///< of the design
    std::vector<double>      at; ///< abscissas of a sensitivity study

    /// Entry Base and the plate test's entries, with their loops.
    std::unique_ptr<ParameterLoops> loops;

    /// Names of the inputs of a sensitivity study.
    std::vector<std::string> inputs;

    /// All cases in the order of the loops, and what of each is needed later.
    struct Details
    {
      unsigned int group = 0;     ///< number of the base file
      std::string  last_stage;    ///< whose end is success
      unsigned int component = 0; ///< mode, driven in the last stage
      StageStarts  starts;
    };
    std::vector<SweepCase> cases;
    std::vector<Details>   details;

    /// Work-precision: reference cases by group, the finest last.
    std::vector<std::vector<SweepCase>> references;
    std::vector<std::string>            group_names;

    /// The study as a documented file; base files are written relative to the
    /// present folder.
    std::string used_file;

    /// As used_file for a file that will stand in another folder.
    std::string
    used_file_in(const std::string &folder) const;

    /// Bind the members to the entries of subsection "Study".
    void
    add_parameters(dealii::ParameterHandler &prm);

    /**
     * Read and check the study and every single case of it.
     *
     * Throws InputError with one sentence for the first mistake, and the case
     * in which it is one.
     */
    static StudyParameters
    read(const ParameterText            &text,
         const std::vector<std::string> &overrides = {});

  private:
    struct Texts; // the parts of the file

    void
    add_picture_parameters(dealii::ParameterHandler &prm);

    void
    set_curve();

    void
    read_base_files(Texts &texts);

    /// The plate test's entries with loops, in which ranges are sampled.
    ParameterText
    sample_ranges(const Texts &texts, std::vector<std::string> &paths) const;

    /// As in tables: the name of the loop, numbered where it has several.
    void
    name_inputs(const std::vector<std::string> &paths);

    void
    check_swept_entries() const;

    Details
    read_case(const Texts         &texts,
              const unsigned int   group,
              const ParameterText &entries,
              const std::string   &name,
              SweepCase           &result) const;

    void
    read_cases(const Texts &texts);

    void
    read_references(const Texts &texts);

    std::string              base_;                // entry Base
    std::string              curve_ = "automatic"; // entry Curve
    std::vector<std::string> base_files_; // by group, as found from here
    std::string              documented_, reference_, rest_;
  };

  template <>
  const EnumNames<StudyParameters::Kind> &
  enum_names<StudyParameters::Kind>();

  /// Path of the entry Base among the loops of a study.
  inline const std::string base_entry = "Study/Base";

  /// A value as tables and pictures show it: base files without their folder.
  std::string
  display_value(const ParameterLoop &loop, const std::string &value);

  /**
   * Words for a case or panel: the values of the given axes. An array that
   * only repeats the values of its partner (equal penalties) is left out.
   *
   * @param names_of_numbers_only Values that are words stand alone: "mortar"
   *   for "Method mortar".
   */
  std::string
  describe_axes(const ParameterLoops         &loops,
                const std::set<unsigned int> &axes,
                const unsigned int            c,
                const bool                    names_of_numbers_only = false);
} // namespace NPT

#endif
