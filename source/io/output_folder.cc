// SPDX-License-Identifier: LGPL-2.1-or-later
// The lock and the list of files of a folder of results.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/io/output_folder.h>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>

namespace NPT
{
  namespace
  {
    namespace fs = std::filesystem;

    const std::string list_name = "files.txt";

    // Of this process, by directory.
    std::map<std::string, OutputFolder *> &
    folders_in_use()
    {
      static std::map<std::string, OutputFolder *> folders;
      return folders;
    }

    std::string
    normal_form(const std::string &directory)
    {
      std::string text = fs::path(directory).lexically_normal().string();
      while (text.size() > 1 && text.back() == '/')
        text.pop_back();
      return text.empty() ? "." : text;
    }

    // A list that somebody has edited must not reach out of the folder.
    bool
    is_plain_name(const std::string &name)
    {
      return !name.empty() && name[0] != '#' && name != "." && name != ".." &&
             name != list_name && name.find('/') == std::string::npos;
    }

    // A disk that takes a part of a text only tells the reason with the rest.
    bool
    write_all(const int file, const std::string &text)
    {
      for (std::size_t done = 0; done < text.size();)
        {
          const ssize_t n = write(file, text.data() + done, text.size() - done);
          if (n < 0 && errno != EINTR)
            return false;
          done += std::max<ssize_t>(n, 0);
        }
      return true;
    }

    void
    remove_file(const std::string &directory, const std::string &name)
    {
      const std::string path = directory + "/" + name;
      for (const std::string &file : {path, path + ".part"})
        if (unlink(file.c_str()) != 0 && errno != ENOENT && errno != EISDIR)
          throw OutputError(file, std::strerror(errno));
    }
  } // namespace



  OutputFolder::OutputFolder(const std::string &directory, const Start start)
    : directory_(directory.empty() ? "" : normal_form(directory))
  {
    if (directory_.empty())
      return;
    const std::string list = directory_ + "/" + list_name;
    list_ = open(list.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_APPEND, 0666);
    if (list_ < 0)
      throw OutputError(list, std::strerror(errno));
    // Some file systems of networks have no locks; there nobody is refused.
    if (flock(list_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
      {
        close(list_);
        throw InputError("The output directory '" + directory +
                         "' is in use by another run; wait for its end, or "
                         "give this run another one by --output.");
      }
    // What is no file (a device) may have no end.
    std::ifstream in;
    if (fs::is_regular_file(list))
      in.open(list);
    for (std::string name; std::getline(in, name);)
      if (is_plain_name(name) &&
          std::find(files_.begin(), files_.end(), name) == files_.end())
        files_.push_back(name);
    try
      {
        if (start == Start::clean)
          keep_only({});
        else if (files_.empty())
          write_list();
      }
    catch (const OutputError &)
      {
        close(list_);
        throw;
      }
    folders_in_use()[directory_] = this;
  }



  OutputFolder::~OutputFolder()
  {
    if (directory_.empty())
      return;
    folders_in_use().erase(directory_);
    close(list_); // which ends the lock
  }



  void
  OutputFolder::keep_only(const std::vector<std::string> &names)
  {
    if (directory_.empty())
      return;
    std::vector<std::string> kept;
    for (const std::string &file : files_)
      if (std::find(names.begin(), names.end(), file) != names.end())
        {
          remove_file(directory_, file + ".part");
          kept.push_back(file);
        }
      else
        remove_file(directory_, file);
    files_ = kept;
    // Names of files that are not there do no harm, but those of files that
    // are must not be lost, not even in between.
    if (kept.empty())
      write_list();
  }



  // Also shows before anything is computed whether the folder can be written.
  void
  OutputFolder::write_list() const
  {
    std::string text =
      "# What the last run wrote here; the next one removes these files.\n";
    for (const std::string &file : files_)
      text += file + "\n";
    if ((ftruncate(list_, 0) != 0 && errno != EINVAL) ||
        !write_all(list_, text))
      throw OutputError(directory_ + "/" + list_name, std::strerror(errno));
  }



  void
  OutputFolder::add(const std::string &name)
  {
    if (!is_plain_name(name) ||
        std::find(files_.begin(), files_.end(), name) != files_.end())
      return;
    const std::string line = name + "\n";
    if (!write_all(list_, line))
      throw OutputError(directory_ + "/" + list_name, std::strerror(errno));
    files_.push_back(name);
  }



  OutputFolder *
  OutputFolder::find(const std::string &directory)
  {
    const auto found = folders_in_use().find(normal_form(directory));
    return directory.empty() || found == folders_in_use().end() ? nullptr :
                                                                  found->second;
  }



  void
  OutputFolder::note(const std::string &filename)
  {
    const fs::path    path(filename);
    const std::string part = ".part";
    std::string       name = path.filename().string();
    if (name.size() > part.size() &&
        name.compare(name.size() - part.size(), part.size(), part) == 0)
      name.resize(name.size() - part.size());
    const std::string folder = path.parent_path().string();
    if (OutputFolder *const owner = find(folder.empty() ? "." : folder))
      owner->add(name);
  }



  void
  OutputFolder::leave_all()
  {
    for (const auto &folder : folders_in_use())
      close(folder.second->list_);
    folders_in_use().clear();
  }



  bool
  OutputFolder::is_in_use(const std::string &directory)
  {
    const std::string list = directory + "/" + list_name;
    const int         file = open(list.c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0)
      return false;
    const bool is_locked =
      flock(file, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    close(file);
    return is_locked;
  }
} // namespace NPT
