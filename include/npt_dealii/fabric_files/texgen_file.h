// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines a TexGen file as it is read: its values with their units, and its
// yarns.

#ifndef npt_dealii_fabric_files_texgen_file_h
#define npt_dealii_fabric_files_texgen_file_h

#include <boost/property_tree/ptree.hpp>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace NPT
{
  /// Section of a yarn; lengths in mm.
  struct TexGenSection
  {
    std::string shape; ///< a name of Registry<SectionShape>
    double      width = 0, height = 0, power = 0;
    /// Of the mean of polygons along a woven yarn; else 0.
    double area = 0;

    bool
    is_woven() const
    {
      return area > 0.;
    }
    /// To six digits; to two of woven yarns, whose sections differ a little.
    bool
    operator==(const TexGenSection &other) const;
  };

  /// Yarn as the file has it; lengths in mm.
  struct TexGenYarn
  {
    std::string                        name; ///< "yarn 3" in messages
    std::optional<TexGenSection>       section;
    std::vector<std::array<double, 3>> nodes;
    std::vector<std::array<double, 3>> repeats;
  };

  /**
   * A TexGen file: what stands in its elements, checked, in mm.
   *
   * All functions throw InputError with one sentence that names the file and
   * what was found. `where` is what the sentence calls the element.
   */
  class TexGenFile
  {
  public:
    using Tree = boost::property_tree::ptree;

    explicit TexGenFile(const std::string &filename);

    [[noreturn]] void
    refuse(const std::string &what) const;

    /// The only textile of the file; its GeometryScale is that of all lengths
    /// from now on.
    const Tree &
    textile();

    static std::string
    text(const Tree        &tree,
         const std::string &attribute,
         const std::string &otherwise);
    double
    to_number(const std::string &value, const std::string &where) const;
    /// Positive, in mm.
    double
    length(const Tree        &tree,
           const std::string &attribute,
           const std::string &where) const;
    /// A length in mm of any sign.
    double
    scaled(const std::string &value, const std::string &where) const;
    /// 1 to 1000.
    unsigned int
    count(const Tree &tree, const std::string &attribute) const;
    unsigned int
    index_below(const Tree        &tree,
                const std::string &attribute,
                const unsigned int end,
                const std::string &where) const;

    /// The yarns in their order.
    std::vector<TexGenYarn>
    read_yarns(const Tree &textile) const;

  private:
    double
    unit(const std::string &name) const;
    // n numbers in mm, separated by commas.
    std::vector<double>
    lengths(const std::string &value,
            const unsigned int n,
            const std::string &where) const;
    std::array<double, 3>
    vector_of(const std::string &value, const std::string &where) const;
    TexGenSection
    read_yarn_section(const Tree &tree, const std::string &yarn) const;
    TexGenSection
    read_section(const Tree &tree, const std::string &yarn) const;
    TexGenSection
    read_polygons(const Tree &tree, const std::string &yarn) const;
    TexGenSection
    read_polygon(const Tree &tree, const std::string &yarn) const;

    const std::string file_;
    double            scale_ = 1.;
    Tree              tree_;
  };
} // namespace NPT

#endif
