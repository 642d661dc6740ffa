// SPDX-License-Identifier: LGPL-2.1-or-later
// The readers of texts for Clang's libFuzzer, which looks for inputs that take
// new ways through them: the first byte chooses the reader, the rest is the
// file. CMake: NPT_LIBFUZZER.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/parameter_file.h>
#include <npt_dealii/fabric/cell_parameters.h>
#include <npt_dealii/fabric_files/data_sheet.h>
#include <npt_dealii/fabric_files/texgen.h>
#include <npt_dealii/io/table_file.h>
#include <npt_dealii/problems/identification/material_curve.h>

#include <deal.II/base/parameter_handler.h>

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <string>

namespace
{
  // A file that lies in memory, and its name.
  class MemoryFile
  {
  public:
    explicit MemoryFile(const std::string &content)
      : file_(memfd_create("input", MFD_CLOEXEC))
    {
      if (file_ < 0 || write(file_, content.data(), content.size()) !=
                         static_cast<ssize_t>(content.size()))
        std::abort();
    }

    ~MemoryFile()
    {
      close(file_);
    }

    std::string
    name() const
    {
      return "/proc/self/fd/" + std::to_string(file_);
    }

  private:
    const int file_;
  };

  void
  read_parameters(const std::string &content)
  {
    NPT::CellParameters      cell;
    NPT::MeshParameters      mesh;
    dealii::ParameterHandler prm;
    cell.add_parameters(prm);
    mesh.add_parameters(prm);
    const auto text = NPT::make_parameter_text(content, "file.prm");
    NPT::parse_parameter_text(prm, text);
    cell.check();
    // What is printed is read.
    NPT::parse_parameter_text(
      prm,
      NPT::make_parameter_text(NPT::documented_parameters(prm), "printed.prm"));
  }

  void
  read_columns(const std::string &content)
  {
    const NPT::Table table = NPT::read_table(MemoryFile(content).name());
    for (const std::string &name : table.column_names)
      {
        table.unit(name);
        table.text_column(name);
        table.column(name);
      }
  }

  void
  read_weave(const std::string &content)
  {
    const MemoryFile   file(content);
    std::ostringstream out;
    NPT::write_parameter_file(NPT::read_texgen(file.name()), "weave.tg3", out);
    read_parameters(out.str().substr(0, out.str().find("subsection Load")));
  }

  void
  read_curves(const std::string &content)
  {
    NPT::read_material_curves(MemoryFile(content).name());
  }

  void
  read_sheet(const std::string &content)
  {
    std::ostringstream out;
    NPT::write_parameter_file(
      NPT::DataSheet::read(NPT::make_parameter_text(content, "file.sheet")),
      "file.sheet",
      out);
    // Cell and mesh, which stand first.
    const std::string text = out.str();
    read_parameters(text.substr(0,
                                std::min(text.find("subsection Fiber"),
                                         text.find("subsection Contact"))));
  }
} // namespace

extern "C" int
LLVMFuzzerTestOneInput(const std::uint8_t *data, const std::size_t size)
{
  if (size == 0)
    return 0;
  const std::string content(reinterpret_cast<const char *>(data + 1), size - 1);
  try
    {
      switch (data[0] % 5)
        {
          case 0:
            read_parameters(content);
            break;
          case 1:
            read_columns(content);
            break;
          case 2:
            read_weave(content);
            break;
          case 3:
            read_curves(content);
            break;
          default:
            read_sheet(content);
        }
    }
  catch (const NPT::InputError &)
    {
      // The answer that wrong input should get; all others end the fuzzer.
    }
  return 0;
}
