// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims about checkpoints that are not what they should be.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/io/checkpoint_file.h>

#include <catch2/catch.hpp>

#include <filesystem>
#include <fstream>
#include <sstream>

using namespace NPT;
using Catch::Contains;
namespace fs = std::filesystem;

namespace
{
  const fs::path checkpoint_folder =
    fs::path(NPT_BINARY_DIR) / "test_io_files" / "checkpoint";

  std::string
  checkpoint_file(const std::string &text)
  {
    fs::create_directories(checkpoint_folder);
    const std::string name = (checkpoint_folder / "checkpoint.bin").string();
    std::ofstream(name, std::ios::binary) << text;
    return name;
  }

  const char        bytes[] = "A state\n with a zero \0 and \xff in it";
  const std::string contents(bytes, sizeof(bytes) - 1);

  std::string
  good_file()
  {
    const std::string name = checkpoint_file("");
    write_checkpoint_file(name, 3, contents);
    std::ifstream      in(name, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
  }
} // namespace



TEST_CASE("A checkpoint is read as it was written", "[io]")
{
  const std::string name = checkpoint_file(good_file());
  CHECK(read_checkpoint_file(name, 3).value() == contents);
  CHECK_FALSE(read_checkpoint_file(name + ".other", 3).has_value());
  CHECK_THROWS_WITH(read_checkpoint_file(name, 4),
                    Contains("has version 3") && Contains("reads version 4") &&
                      Contains(name));
}



TEST_CASE("A checkpoint cut short anywhere is refused", "[io]")
{
  const std::string text = good_file();
  for (std::size_t n = 0; n < text.size(); ++n)
    {
      INFO("after " << n << " bytes");
      const std::string name = checkpoint_file(text.substr(0, n));
      CHECK_THROWS_AS(read_checkpoint_file(name, 3), InputError);
    }
  CHECK_THROWS_WITH(
    read_checkpoint_file(checkpoint_file(text.substr(0, text.size() - 1)), 3),
    Contains("cut short: " + std::to_string(contents.size() - 1) + " of " +
             std::to_string(contents.size()) + " bytes are there"));
  CHECK_THROWS_WITH(read_checkpoint_file(checkpoint_file(text + "x"), 3),
                    Contains("damaged"));
}



TEST_CASE("A checkpoint with one wrong bit anywhere is refused", "[io]")
{
  const std::string text = good_file();
  for (std::size_t n = 0; n < text.size(); ++n)
    for (unsigned int bit = 0; bit < 8; ++bit)
      {
        std::string damaged = text;
        damaged[n] ^= static_cast<char>(1 << bit);
        INFO("byte " << n << ", bit " << bit);
        const std::string name = checkpoint_file(damaged);
        CHECK_THROWS_AS(read_checkpoint_file(name, 3), InputError);
      }
}
