// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the one way in which files of results are written: what does not
// reach a file is an OutputError with the reason of the system.

#ifndef npt_dealii_io_output_file_h
#define npt_dealii_io_output_file_h

#include <array>
#include <ostream>
#include <streambuf>
#include <string>

namespace NPT
{
  /**
   * A file that grows: a log, a table. What write() was given is in the file
   * when it returns, also if the program is killed then. All functions throw
   * OutputError.
   *
   * The file is noted in the list of its folder, see OutputFolder.
   */
  class OutputFile
  {
  public:
    enum class Start
    {
      empty, ///< what was there is lost
      end    ///< what was there stays
    };

    explicit OutputFile(const std::string &filename,
                        const Start        start = Start::empty);
    /// Closes the file; what goes wrong then is not said.
    ~OutputFile();

    OutputFile(const OutputFile &) = delete;
    OutputFile &
    operator=(const OutputFile &) = delete;

    void
    write(const std::string &text);
    void
    write(const char *text, std::size_t size);
    /// Wait until the disk itself has what was written.
    void
    synchronize();
    /// May tell of an error that no write() has met, over a network.
    void
    close();

  private:
    [[noreturn]] void
    fail() const;

    const std::string filename_;
    int               file_ = -1;
  };

  /**
   * A file that is replaced as a whole: written beside its name, as FILE.part,
   * and moved there by finish(), so that an interrupted run leaves either the
   * old or the new one, never half.
   */
  class ReplacedFile
  {
  public:
    explicit ReplacedFile(const std::string &filename);
    /// Removes what is there without finish().
    ~ReplacedFile();

    ReplacedFile(const ReplacedFile &) = delete;
    ReplacedFile &
    operator=(const ReplacedFile &) = delete;

    /// Throws OutputError where another stream would only be marked as bad.
    std::ostream &
    stream()
    {
      return stream_;
    }

    /// @param synchronized Survives also a failure of power.
    void
    finish(const bool synchronized = false);

  private:
    // Hands what is written on in large pieces.
    class Buffer : public std::streambuf
    {
    public:
      explicit Buffer(OutputFile &file);

    protected:
      int_type
      overflow(int_type c) override;
      int
      sync() override;

    private:
      OutputFile            &file_;
      std::array<char, 8192> text_;
    };

    const std::string filename_, part_;
    OutputFile        file_;
    Buffer            buffer_;
    std::ostream      stream_;
  };
} // namespace NPT

#endif
