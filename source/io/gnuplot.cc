// SPDX-License-Identifier: LGPL-2.1-or-later
// The frame of gnuplot scripts, and calling gnuplot.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/short_number.h>
#include <npt_dealii/io/gnuplot.h>
#include <npt_dealii/io/output_file.h>
#include <npt_dealii/io/output_folder.h>
#include <npt_dealii/io/replace_file.h>

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <ostream>
#include <thread>
#include <vector>

namespace NPT
{
  namespace
  {
    std::string
    quote_for_shell(const std::string &text)
    {
      std::string result = "'";
      for (const char c : text)
        result += (c == '\'' ? std::string("'\\''") : std::string(1, c));
      return result + "'";
    }

    // As std::system(), but not for longer than so many seconds; nothing if the
    // command had to be ended. It runs in a process group of its own, so that
    // what a wrapper has started ends with it.
    std::optional<int>
    run_command(const std::string &command, const double patience)
    {
      posix_spawnattr_t attributes;
      posix_spawnattr_init(&attributes);
      posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
      posix_spawnattr_setpgroup(&attributes, 0);
      std::string shell = "sh", option = "-c", text = command;
      char *const arguments[] = {shell.data(),
                                 option.data(),
                                 text.data(),
                                 nullptr};
      pid_t       child       = 0;
      const int   failure     = posix_spawn(
        &child, "/bin/sh", nullptr, &attributes, arguments, environ);
      posix_spawnattr_destroy(&attributes);
      if (failure != 0)
        return -1;

      using Clock      = std::chrono::steady_clock;
      const auto start = Clock::now();
      int        pause = 1; // ms; a simple picture takes 50
      for (int status = 0;;)
        {
          const pid_t ended = waitpid(child, &status, WNOHANG);
          if (ended == child)
            return status;
          if (ended < 0 && errno != EINTR)
            return -1;
          if (std::chrono::duration<double>(Clock::now() - start).count() >
              patience)
            break;
          std::this_thread::sleep_for(std::chrono::milliseconds(pause));
          pause = pause < 20 ? 2 * pause : 20;
        }
      kill(-child, SIGKILL);
      while (waitpid(child, nullptr, 0) < 0 && errno == EINTR)
        ;
      return {};
    }
  } // namespace



  std::string
  gnuplot_text(const std::string &text)
  {
    std::string result = "'";
    for (const char c : text)
      result += (c == '\'' ? std::string("''") : std::string(1, c));
    return result + "'";
  }



  std::string
  gnuplot_color(const unsigned int i)
  {
    static const std::vector<std::string> colors = {"#0072b2",
                                                    "#d55e00",
                                                    "#009e73",
                                                    "#cc79a7",
                                                    "#e69f00",
                                                    "#56b4e9",
                                                    "#000000",
                                                    "#999999"};
    return colors[i % colors.size()];
  }



  void
  write_gnuplot_script(const std::string                         &script,
                       const GnuplotPicture                      &picture,
                       const std::function<void(std::ostream &)> &write_panels)
  {
    // gnuplot writes them, not this program.
    for (const char *extension : {".svg", ".png"})
      OutputFolder::note((std::filesystem::path(script).parent_path() /
                          (picture.name + extension))
                           .string());
    const std::string size =
      std::to_string(picture.width) + "," + std::to_string(picture.height);
    replace_file(script, [&](std::ostream &out) {
      out << "# Draws " << picture.name << ".svg and " << picture.name
          << ".png. Change it and run `gnuplot` on it in this folder.\n"
          // What the script before it has set, if there was one.
          << "reset\n"
          << "set datafile separator comma\n"
          << "set datafile columnheaders\n"
          << "set grid linecolor rgb '#dddddd' linetype 1 linewidth 1\n"
          << "set tics nomirror out\n"
          << picture.settings << "\n"
          << "do for [kind in 'svg pngcairo'] {\n"
          << "  if (strstrt(' '.GPVAL_TERMINALS.' ', ' '.kind.' ') == 0) { "
             "continue }\n"
          << "  if (kind eq 'svg') {\n"
          << "    set terminal svg size " << size
          << " font 'sans-serif,13' background 'white' dynamic\n"
          << "    set output " << gnuplot_text(picture.name + ".svg") << "\n"
          << "  } else {\n"
          << "    set terminal pngcairo size " << size
          << " font 'sans-serif,11' background 'white'\n"
          << "    set output " << gnuplot_text(picture.name + ".png") << "\n"
          << "  }\n"
          << "  set multiplot layout " << picture.n_rows << ","
          << picture.n_columns;
      if (!picture.title.empty())
        out << " title " << gnuplot_text(picture.title) << " noenhanced";
      out << "\n";
      write_panels(out);
      out << "\n  unset multiplot\n"
          << "  unset output\n"
          << "}\n";
    });
  }



  namespace
  {
    namespace fs = std::filesystem;

    // The pictures of a script that are there; gnuplot may lack a format.
    std::vector<std::string>
    pictures_of(const std::string &folder, const std::string &script)
    {
      std::vector<std::string> pictures;
      for (const char *extension : {".svg", ".png"})
        {
          const fs::path picture =
            fs::path(folder) / fs::path(script).replace_extension(extension);
          std::error_code error;
          if (fs::exists(picture, error))
            pictures.push_back(picture.string());
        }
      return pictures;
    }

    // Whether a picture has its end. What is no file has none.
    bool
    is_complete(const std::string &picture)
    {
      if (!fs::is_regular_file(picture))
        return false;
      std::ifstream     in(picture, std::ios::binary | std::ios::ate);
      const std::size_t size = in ? static_cast<std::size_t>(in.tellg()) : 0;
      std::string       end(std::min<std::size_t>(size, 32), ' ');
      const std::string last =
        picture.substr(picture.size() - 3) == "svg" ? "</svg>" : "IEND";
      in.seekg(size - end.size());
      in.read(end.data(), end.size());
      return in && end.find(last) != std::string::npos;
    }

    // gnuplot does not tell that a disk is full. Asked by writing, the system
    // does; what is no file and can be written (/dev/null) is as good as
    // complete.
    void
    check_picture(const std::string &picture, const bool gnuplot_succeeded)
    {
      if (is_complete(picture))
        return;
      const bool is_file = fs::is_regular_file(picture);
      OutputFile(picture).write(std::string(1 << 20, ' '));
      if (!is_file)
        return;
      std::remove(picture.c_str());
      if (gnuplot_succeeded)
        throw OutputError(picture, "gnuplot left it incomplete");
    }
  } // namespace



  std::string
  run_gnuplot(const std::string &script, const double patience)
  {
    const std::size_t slash = script.find_last_of('/');
    if (slash == std::string::npos)
      return run_gnuplot(".", {script}, patience);
    return run_gnuplot(script.substr(0, slash + 1),
                       {script.substr(slash + 1)},
                       patience);
  }



  std::string
  run_gnuplot(const std::string              &folder,
              const std::vector<std::string> &scripts,
              const double                    patience)
  {
    std::string command = "cd " + quote_for_shell(folder) + " && gnuplot";
    std::string names;
    for (const std::string &script : scripts)
      {
        command += " " + quote_for_shell(script);
        names +=
          (names.empty() ? "" : ", ") +
          (folder == "." ? "" : folder + (folder.back() == '/' ? "" : "/")) +
          script;
      }

    const auto status =
      run_command(command + " >/dev/null 2>&1 </dev/null", patience);
    // 127 is the shell's answer to an unknown program.
    const bool has_ended = status && *status != -1 && WIFEXITED(*status);
    const bool succeeded = has_ended && WEXITSTATUS(*status) == 0;
    if (!has_ended || WEXITSTATUS(*status) != 127)
      for (const std::string &script : scripts)
        for (const std::string &picture : pictures_of(folder, script))
          check_picture(picture, succeeded);
    if (!status)
      return "gnuplot had not drawn " + names + " after " +
             short_number(patience) +
             " s and was ended; a picture may be missing; run it by hand to see "
             "why.";
    if (succeeded)
      return "";
    if (has_ended && WEXITSTATUS(*status) == 127)
      return "gnuplot was not found, no picture is drawn; install gnuplot and "
             "run it on " +
             names + ".";
    return "gnuplot failed on " + names +
           ", no picture is drawn; run it by hand to see why.";
  }
} // namespace NPT
