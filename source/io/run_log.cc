// SPDX-License-Identifier: LGPL-2.1-or-later
// The lines of the log and the drawing of the progress bar.

#include <npt_dealii/io/run_log.h>

#include <deal.II/base/config.h>
#include <deal.II/base/exceptions.h>

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>

namespace NPT
{
  using namespace dealii;

  namespace
  {
    // printf formats align numbers more readably than stream manipulators.
    template <typename... Arguments>
    std::string
    format(const char *pattern, const Arguments &...arguments)
    {
      char buffer[256];
      std::snprintf(buffer, sizeof(buffer), pattern, arguments...);
      return buffer;
    }
  } // namespace



  RunLog::RunLog(const std::string      &logfile,
                 std::ostream           &screen,
                 const bool              is_terminal,
                 const bool              quiet,
                 const OutputFile::Start start)
    : screen_(screen)
    , is_terminal_(is_terminal)
    , quiet_(quiet)
  {
    if (!logfile.empty())
      file_.emplace(logfile, start);
  }



  RunLog
  RunLog::in_folder(const std::string      &folder,
                    std::ostream           &screen,
                    const OutputFile::Start start)
  {
    const bool has_folder = !folder.empty();
    return RunLog(has_folder ? folder + "/log.txt" : "",
                  screen,
                  has_folder && standard_output_is_terminal(),
                  !has_folder,
                  start);
  }



  RunLog::~RunLog()
  {
    finish();
  }



  void
  RunLog::header(
    const std::string                                      &program,
    const std::vector<std::pair<std::string, std::string>> &entries)
  {
    std::size_t width = 0;
    for (const auto &entry : entries)
      width = std::max(width, entry.first.size());

    line(program + " on deal.II " + DEAL_II_PACKAGE_VERSION);
    for (const auto &entry : entries)
      line("  " + entry.first + std::string(width - entry.first.size(), ' ') +
           "  " + entry.second);
  }



  void
  RunLog::line(const std::string &text)
  {
    write(text, !quiet_);
  }



  void
  RunLog::note(const std::string &text)
  {
    write(text, false);
  }



  void
  RunLog::warning(const std::string &text)
  {
    write("Warning: " + text, true);
  }



  void
  RunLog::cut(const std::string &stage,
              const double       load_factor,
              const std::string &reason,
              const double       next_step)
  {
    write("  cut " + stage + format(" at %.6f: ", load_factor) + reason +
            format("; next step %.3g", next_step),
          true);
  }



  void
  RunLog::progress(const double fraction, const double elapsed_seconds)
  {
    if (!is_terminal_ || quiet_)
      return;

    constexpr int width = 30;
    const double  done  = std::min(1., std::max(0., fraction));
    const int     full  = static_cast<int>(done * width);
    std::string   text  = "[" + std::string(full, '#') +
                       std::string(width - full, '.') + "] " +
                       format("%3d %%", static_cast<int>(100. * done));

    // The first percent is set-up rather than pace.
    if (done >= 0.01 && done < 1.)
      text += ", about " +
              format_duration(elapsed_seconds * (1. - done) / done) + " left";
    if (text == bar_)
      return;
    erase_bar();
    bar_ = text;
    screen_ << bar_ << std::flush;
  }



  void
  RunLog::finish()
  {
    erase_bar();
    screen_ << std::flush;
  }



  void
  RunLog::write(const std::string &text, const bool on_screen)
  {
    if (file_)
      file_->write(text + "\n");
    if (on_screen)
      {
        erase_bar();
        screen_ << text << std::endl;
      }
  }



  void
  RunLog::erase_bar()
  {
    if (bar_.empty())
      return;
    // Blanks instead of an escape sequence: every terminal knows them.
    screen_ << '\r' << std::string(bar_.size(), ' ') << '\r';
    bar_.clear();
  }



  bool
  standard_output_is_terminal()
  {
    return isatty(STDOUT_FILENO) == 1;
  }



  double
  process_cpu_seconds()
  {
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
  }



  std::string
  format_duration(const double seconds)
  {
    const long s = std::lround(std::max(0., seconds));
    if (s < 60)
      return format("%ld s", s);
    if (s < 3600)
      return format("%ld min %02ld s", s / 60, s % 60);
    return format("%ld h %02ld min", s / 3600, (s % 3600) / 60);
  }
} // namespace NPT
