// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines a folder of results: who may write there, and which files are those
// of the run.

#ifndef npt_dealii_io_output_folder_h
#define npt_dealii_io_output_folder_h

#include <string>
#include <vector>

namespace NPT
{
  /**
   * The folder of one run, for as long as the run lasts. Another run cannot use
   * it in that time, on this machine or, where the file system can, on others.
   *
   * The file `files.txt` lists what the run writes there, each name before the
   * file comes to be. The next run removes these files, and no others: whatever
   * else lies in the folder stays.
   */
  class OutputFolder
  {
  public:
    enum class Start
    {
      clean, ///< the files of the run before are removed
      add    ///< they stay and count as this run's
    };

    /**
     * @param directory Existing folder; empty: nothing is done (processes that
     *   do not write).
     *
     * Throws InputError if another run uses the folder, OutputError if nothing
     * can be written there.
     */
    explicit OutputFolder(const std::string &directory,
                          const Start        start = Start::clean);
    ~OutputFolder();

    OutputFolder(const OutputFolder &) = delete;
    OutputFolder &
    operator=(const OutputFolder &) = delete;

    /// Names of the files of this run, in the order in which they came to be.
    const std::vector<std::string> &
    files() const
    {
      return files_;
    }

    /// Remove the files of this run but those with the given names.
    void
    keep_only(const std::vector<std::string> &names);

    /// The folder in use by this process under that name, or null.
    static OutputFolder *
    find(const std::string &directory);

    /// A file is about to be written; OutputFile and ReplacedFile say so.
    /// Files of other folders than those in use are not noted.
    static void
    note(const std::string &filename);

    /// A copy of this process, by fork(), has no part in its folders: they are
    /// free when this process ends.
    static void
    leave_all();

    /// Whether a run uses a folder.
    static bool
    is_in_use(const std::string &directory);

  private:
    void
    write_list() const;
    void
    add(const std::string &name);

    const std::string        directory_; // as given, in normal form
    int                      list_ = -1; // the open list, which is locked
    std::vector<std::string> files_;
  };
} // namespace NPT

#endif
