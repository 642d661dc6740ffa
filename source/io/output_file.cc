// SPDX-License-Identifier: LGPL-2.1-or-later
// Writing by the calls of the system, which tell why they fail.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/io/output_file.h>
#include <npt_dealii/io/output_folder.h>

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

namespace NPT
{
  OutputFile::OutputFile(const std::string &filename, const Start start)
    : filename_(filename)
  {
    OutputFolder::note(filename);
    file_ = open(filename.c_str(),
                 O_WRONLY | O_CREAT | O_CLOEXEC | O_APPEND |
                   (start == Start::empty ? O_TRUNC : 0),
                 0666);
    if (file_ < 0)
      fail();
  }



  OutputFile::~OutputFile()
  {
    if (file_ >= 0)
      ::close(file_);
  }



  void
  OutputFile::fail() const
  {
    throw OutputError(filename_, std::strerror(errno));
  }



  void
  OutputFile::write(const std::string &text)
  {
    write(text.data(), text.size());
  }



  void
  OutputFile::write(const char *text, std::size_t size)
  {
    while (size > 0)
      {
        const ssize_t n = ::write(file_, text, size);
        if (n < 0 && errno == EINTR) // by a signal, before anything was written
          continue;
        if (n < 0)
          fail();
        text += n;
        size -= n;
      }
  }



  void
  OutputFile::synchronize()
  {
    // What is no file (a pipe, a device) has no disk.
    if (fsync(file_) != 0 && errno != EINVAL && errno != EROFS)
      fail();
  }



  void
  OutputFile::close()
  {
    const int file = file_;
    file_          = -1;
    if (file >= 0 && ::close(file) != 0 && errno != EINTR)
      fail();
  }



  ReplacedFile::Buffer::Buffer(OutputFile &file)
    : file_(file)
  {
    setp(text_.data(), text_.data() + text_.size());
  }



  ReplacedFile::Buffer::int_type
  ReplacedFile::Buffer::overflow(const int_type c)
  {
    sync();
    if (!traits_type::eq_int_type(c, traits_type::eof()))
      {
        *pptr() = traits_type::to_char_type(c);
        pbump(1);
      }
    return traits_type::not_eof(c);
  }



  int
  ReplacedFile::Buffer::sync()
  {
    file_.write(pbase(), pptr() - pbase());
    setp(text_.data(), text_.data() + text_.size());
    return 0;
  }



  ReplacedFile::ReplacedFile(const std::string &filename)
    : filename_(filename)
    , part_(filename + ".part")
    , file_(part_)
    , buffer_(file_)
    , stream_(&buffer_)
  {
    stream_.exceptions(std::ios::badbit);
  }



  ReplacedFile::~ReplacedFile()
  {
    if (!part_.empty())
      std::remove(part_.c_str());
  }



  void
  ReplacedFile::finish(const bool synchronized)
  {
    stream_.flush();
    if (synchronized)
      file_.synchronize();
    file_.close();
    OutputFolder::note(filename_);
    if (std::rename(part_.c_str(), filename_.c_str()) != 0)
      throw OutputError(filename_, std::strerror(errno));
  }
} // namespace NPT
