// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines what a run says while it runs: the log on screen and in log.txt, and
// the progress bar of a terminal.

#ifndef npt_dealii_io_run_log_h
#define npt_dealii_io_run_log_h

#include <npt_dealii/io/output_file.h>

#include <optional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

namespace NPT
{
  /**
   * Writes each line to the screen and to a file, flushed; a screen that is
   * gone (`| head`) is no error, a full disk is. The log contains
   * no date and no host, so that the logs of two runs can be compared.
   *
   * The progress bar goes to the screen only, and only if that is a terminal:
   * it is redrawn in place and removed before the next line.
   *
   * With several processes only one of them should have a log.
   */
  class RunLog
  {
  public:
    /**
     * @param logfile     E.g. "output/log.txt"; empty for none.
     * @param screen      Usually std::cout.
     * @param is_terminal Whether @p screen can redraw a line; see
     *   standard_output_is_terminal().
     * @param quiet       Only warnings and cut steps reach the screen; the
     *   file gets all.
     * @param start       Whether an older log in the file stays.
     */
    RunLog(const std::string      &logfile,
           std::ostream           &screen,
           const bool              is_terminal,
           const bool              quiet = false,
           const OutputFile::Start start = OutputFile::Start::empty);

    /// The log of a run: log.txt in a folder of results. Without a folder there
    /// is no file, and the log is quiet.
    static RunLog
    in_folder(const std::string      &folder,
              std::ostream           &screen,
              const OutputFile::Start start = OutputFile::Start::empty);

    /// Calls finish().
    ~RunLog();

    RunLog(const RunLog &) = delete;

    RunLog &
    operator=(const RunLog &) = delete;

    /**
     * Open the log: program and version, version of deal.II, and the given
     * names and values (number of unknowns, ...) in aligned columns.
     */
    void
    header(const std::string                                      &program,
           const std::vector<std::pair<std::string, std::string>> &entries);

    void
    line(const std::string &text);

    /// A line for the file alone: what the screen shows in another way.
    void
    note(const std::string &text);

    /// A line with "Warning: " in front.
    void
    warning(const std::string &text);

    /**
     * A failed step that is tried again with a smaller one.
     *
     * @param load_factor The load factor that could not be reached.
     * @param reason      See LoadStepFailure::reason().
     * @param next_step   Increment of the load factor that is tried next.
     */
    void
    cut(const std::string &stage,
        const double       load_factor,
        const std::string &reason,
        const double       next_step);

    /**
     * Redraw the progress bar.
     *
     * @param fraction        Done of the whole load programme, 0 to 1.
     * @param elapsed_seconds Since the start; the remaining time assumes that
     *   the rest goes at the same pace.
     */
    void
    progress(const double fraction, const double elapsed_seconds);

    /// Remove the progress bar. The log may be used on.
    void
    finish();

  private:
    void
    write(const std::string &text, const bool on_screen);

    void
    erase_bar();

    std::optional<OutputFile> file_;
    std::ostream             &screen_;
    const bool                is_terminal_;
    const bool                quiet_;
    std::string               bar_;
  };

  /// Whether standard output is a terminal and not a file or a pipe.
  bool
  standard_output_is_terminal();

  /// CPU time that this process has used so far.
  double
  process_cpu_seconds();

  /// "42 s", "3 min 05 s", "2 h 07 min".
  std::string
  format_duration(const double seconds);
} // namespace NPT

#endif
