// SPDX-License-Identifier: LGPL-2.1-or-later
// The XML of VTU files, the numbering of VTK's higher-order cells, and the
// encodings of their arrays.

#include <npt_dealii/io/replace_file.h>
#include <npt_dealii/io/vtu_file.h>

#include <deal.II/base/config.h>
#include <deal.II/base/exceptions.h>
#include <deal.II/base/utilities.h>

#ifdef DEAL_II_WITH_ZLIB
#  include <zlib.h>
#endif

#include <cstdint>
#include <cstring>
#include <limits>
#include <ostream>

namespace NPT
{
  using namespace dealii;

  namespace
  {
    constexpr std::uint8_t vtk_bezier_quadrilateral = 77;
    constexpr std::uint8_t vtk_bezier_hexahedron    = 79;

    // The counter-clockwise number of a corner of the unit square.
    unsigned int
    corner_of_square(const bool i, const bool j)
    {
      return i ? (j ? 2 : 1) : (j ? 3 : 0);
    }

    unsigned int
    vtk_position_in_quadrilateral(const unsigned int i,
                                  const unsigned int j,
                                  const unsigned int p,
                                  const unsigned int q)
    {
      const bool         i_end = (i == 0 || i == p), j_end = (j == 0 || j == q);
      const unsigned int m = p - 1, n = q - 1; // interior points of an edge

      if (i_end && j_end)
        return corner_of_square(i > 0, j > 0);
      if (j_end)
        return 4 + (j > 0 ? m + n : 0) + (i - 1);
      if (i_end)
        return 4 + (i > 0 ? m : 2 * m + n) + (j - 1);
      return 4 + 2 * (m + n) + (j - 1) * m + (i - 1);
    }

    unsigned int
    vtk_position_in_hexahedron(const unsigned int                 i,
                               const unsigned int                 j,
                               const unsigned int                 k,
                               const std::array<unsigned int, 3> &degrees)
    {
      const bool i_end = (i == 0 || i == degrees[0]);
      const bool j_end = (j == 0 || j == degrees[1]);
      const bool k_end = (k == 0 || k == degrees[2]);

      // Interior points of an edge in each direction.
      const unsigned int l = degrees[0] - 1;
      const unsigned int m = degrees[1] - 1;
      const unsigned int n = degrees[2] - 1;

      // Corners: below, then above.
      if (i_end && j_end && k_end)
        return (k > 0 ? 4 : 0) + corner_of_square(i > 0, j > 0);

      // Edges: the four below, the four above, then the four upright ones.
      const unsigned int edges = 8;
      const unsigned int level = edges + (k > 0 ? 2 * (l + m) : 0);
      if (j_end && k_end)
        return level + (j > 0 ? l + m : 0) + (i - 1);
      if (i_end && k_end)
        return level + (i > 0 ? l : 2 * l + m) + (j - 1);
      if (i_end && j_end)
        return edges + 4 * (l + m) + corner_of_square(i > 0, j > 0) * n +
               (k - 1);

      // Faces: normal to the first, the second, the third direction.
      const unsigned int faces = edges + 4 * (l + m + n);
      if (i_end)
        return faces + (i > 0 ? m * n : 0) + (k - 1) * m + (j - 1);
      if (j_end)
        return faces + 2 * m * n + (j > 0 ? l * n : 0) + (k - 1) * l + (i - 1);
      if (k_end)
        return faces + 2 * (m * n + l * n) + (k > 0 ? l * m : 0) + (j - 1) * l +
               (i - 1);

      const unsigned int interior = faces + 2 * (m * n + l * n + l * m);
      return interior + ((k - 1) * m + (j - 1)) * l + (i - 1);
    }



    std::string
    escape_xml(const std::string &text)
    {
      std::string result;
      for (const char c : text)
        if (c == '&')
          result += "&amp;";
        else if (c == '<')
          result += "&lt;";
        else if (c == '"')
          result += "&quot;";
        else
          result += c;
      return result;
    }

    const char *
    byte_order()
    {
      const std::uint16_t one = 1;
      unsigned char       first_byte;
      std::memcpy(&first_byte, &one, 1);
      return first_byte == 1 ? "LittleEndian" : "BigEndian";
    }

    const char *
    type_name(double)
    {
      return "Float64";
    }
    const char *
    type_name(std::int64_t)
    {
      return "Int64";
    }
    const char *
    type_name(std::uint8_t)
    {
      return "UInt8";
    }

    template <typename T>
    std::string
    base64(const T *data, const std::size_t n)
    {
      const auto *bytes = reinterpret_cast<const unsigned char *>(data);
      return Utilities::encode_base64(
        std::vector<unsigned char>(bytes, bytes + n * sizeof(T)));
    }

    // The content of an array with the length that VTK wants in front of it.
    template <typename T>
    void
    write_values(std::ostream         &out,
                 const std::vector<T> &values,
                 const unsigned int    n_components,
                 const Encoding        encoding)
    {
      if (encoding == Encoding::ascii)
        {
          // The unary plus prints a byte as a number.
          for (std::size_t i = 0; i < values.size(); ++i)
            out << +values[i] << ((i + 1) % n_components == 0 ? '\n' : ' ');
          return;
        }

      const std::size_t n_bytes = values.size() * sizeof(T);
#ifdef DEAL_II_WITH_ZLIB
      if (encoding == Encoding::compressed)
        {
          if (n_bytes == 0)
            {
              const std::uint64_t no_blocks[3] = {0, 0, 0};
              out << base64(no_blocks, 3) << '\n';
              return;
            }
          uLongf                     n_compressed = compressBound(n_bytes);
          std::vector<unsigned char> compressed(n_compressed);
          const int                  status =
            compress2(compressed.data(),
                      &n_compressed,
                      reinterpret_cast<const Bytef *>(values.data()),
                      n_bytes,
                      Z_BEST_SPEED);
          AssertThrow(status == Z_OK,
                      ExcMessage("zlib refused to compress an array."));

          // One block: number of blocks, its size, size of the last partial
          // block (none), compressed size.
          const std::uint64_t header[4] = {1, n_bytes, 0, n_compressed};
          out << base64(header, 4) << base64(compressed.data(), n_compressed)
              << '\n';
          return;
        }
#endif
      std::vector<unsigned char> bytes(sizeof(std::uint64_t) + n_bytes);
      const std::uint64_t        length = n_bytes;
      std::memcpy(bytes.data(), &length, sizeof(length));
      if (n_bytes > 0)
        std::memcpy(bytes.data() + sizeof(length), values.data(), n_bytes);
      out << base64(bytes.data(), bytes.size()) << '\n';
    }

    template <typename T>
    void
    write_array(std::ostream         &out,
                const std::string    &name,
                const unsigned int    n_components,
                const std::vector<T> &values,
                const Encoding        encoding)
    {
      out << "        <DataArray type=\"" << type_name(T()) << "\" Name=\""
          << escape_xml(name) << "\" NumberOfComponents=\"" << n_components
          << "\" format=\""
          << (encoding == Encoding::ascii ? "ascii" : "binary") << "\">\n";
      write_values(out, values, n_components, encoding);
      out << "        </DataArray>\n";
    }

    void
    write_fields(std::ostream                   &out,
                 const std::vector<BezierField> &fields,
                 const std::size_t               n,
                 const Encoding                  encoding)
    {
      (void)n;
      for (const BezierField &field : fields)
        {
          Assert(!field.name.empty(), ExcMessage("A field has no name."));
          Assert(field.n_components == 1 || field.n_components == 3 ||
                   field.n_components == 6 || field.n_components == 9,
                 ExcMessage("Field " + field.name + " has " +
                            std::to_string(field.n_components) +
                            " components; 1, 3, 6 or 9 are possible."));
          AssertDimension(field.values.size(), n * field.n_components);
          write_array(
            out, field.name, field.n_components, field.values, encoding);
        }
    }

    struct Cells
    {
      std::vector<std::int64_t> connectivity, offsets;
      std::vector<std::uint8_t> types;
    };

    // The frame of the file; the two callables write the complete PointData and
    // CellData elements.
    template <typename WritePointData, typename WriteCellData>
    void
    write_unstructured_grid(const std::string         &filename,
                            const std::vector<double> &points,
                            const Cells               &cells,
                            const Encoding             encoding,
                            const WritePointData      &write_point_data,
                            const WriteCellData       &write_cell_data)
    {
      replace_file(filename, [&](std::ostream &out) {
        out.precision(std::numeric_limits<double>::max_digits10);
        out << "<?xml version=\"1.0\"?>\n"
            << "<VTKFile type=\"UnstructuredGrid\" version=\"2.2\" "
            << "byte_order=\"" << byte_order() << "\" header_type=\"UInt64\"";
#ifdef DEAL_II_WITH_ZLIB
        if (encoding == Encoding::compressed)
          out << " compressor=\"vtkZLibDataCompressor\"";
#endif
        out << ">\n  <UnstructuredGrid>\n    <Piece NumberOfPoints=\""
            << points.size() / 3 << "\" NumberOfCells=\"" << cells.types.size()
            << "\">\n";
        write_point_data(out);
        write_cell_data(out);
        out << "      <Points>\n";
        write_array(out, "Points", 3, points, encoding);
        out << "      </Points>\n      <Cells>\n";
        write_array(out, "connectivity", 1, cells.connectivity, encoding);
        write_array(out, "offsets", 1, cells.offsets, encoding);
        write_array(out, "types", 1, cells.types, encoding);
        out << "      </Cells>\n    </Piece>\n  </UnstructuredGrid>\n"
            << "</VTKFile>\n";
      });
    }
  } // namespace



  unsigned int
  BezierMesh::n_points_of_cell(const unsigned int cell) const
  {
    AssertIndexRange(cell, degrees.size());
    const auto &p = degrees[cell];
    return (p[0] + 1) * (p[1] + 1) * (dim == 3 ? p[2] + 1 : 1);
  }



  void
  BezierMesh::append_points(const std::vector<std::vector<double>> &values,
                            const std::vector<double>              &all_weights,
                            const std::vector<unsigned int>        &which)
  {
    for (const unsigned int b : which)
      {
        points.insert(points.end(), values[b].begin(), values[b].begin() + 3);
        weights.push_back(all_weights[b]);
        auto value = values[b].begin() + 3;
        for (BezierField &field : point_data)
          for (unsigned int k = 0; k < field.n_components; ++k)
            field.values.push_back(*value++);
      }
  }



  std::vector<unsigned int>
  lexicographic_to_vtk(const unsigned int                 dim,
                       const std::array<unsigned int, 3> &degrees)
  {
    Assert(dim == 2 || dim == 3, ExcMessage("Cells are of dimension 2 or 3."));
    for (unsigned int d = 0; d < dim; ++d)
      Assert(degrees[d] >= 1, ExcMessage("Bezier cells have degree >= 1."));

    std::vector<unsigned int> position;
    for (unsigned int k = 0; k <= (dim == 3 ? degrees[2] : 0); ++k)
      for (unsigned int j = 0; j <= degrees[1]; ++j)
        for (unsigned int i = 0; i <= degrees[0]; ++i)
          position.push_back(
            dim == 3 ?
              vtk_position_in_hexahedron(i, j, k, degrees) :
              vtk_position_in_quadrilateral(i, j, degrees[0], degrees[1]));
    return position;
  }



  void
  write_vtu(const std::string &filename,
            const BezierMesh  &mesh,
            const Encoding     encoding)
  {
    const std::size_t n_points = mesh.weights.size();
    const std::size_t n_cells  = mesh.degrees.size();
    AssertDimension(mesh.points.size(), 3 * n_points);

    // The points stay in the caller's order; only the connectivity follows
    // VTK, which fetches weights and fields through it.
    Cells               cells;
    std::vector<double> degrees;
    std::int64_t        first = 0;
    for (unsigned int c = 0; c < n_cells; ++c)
      {
        const auto position = lexicographic_to_vtk(mesh.dim, mesh.degrees[c]);
        cells.connectivity.resize(first + position.size());
        for (unsigned int a = 0; a < position.size(); ++a)
          cells.connectivity[first + position[a]] = first + a;
        first += position.size();
        cells.offsets.push_back(first);
        cells.types.push_back(mesh.dim == 3 ? vtk_bezier_hexahedron :
                                              vtk_bezier_quadrilateral);
        for (unsigned int d = 0; d < 3; ++d)
          degrees.push_back(d < mesh.dim ? mesh.degrees[c][d] : 0);
      }
    AssertDimension(static_cast<std::size_t>(first), n_points);

    write_unstructured_grid(
      filename,
      mesh.points,
      cells,
      encoding,
      [&](std::ostream &out) {
        out << "      <PointData RationalWeights=\"RationalWeights\">\n";
        write_array(out, "RationalWeights", 1, mesh.weights, encoding);
        write_fields(out, mesh.point_data, n_points, encoding);
        out << "      </PointData>\n";
      },
      [&](std::ostream &out) {
        out << "      <CellData HigherOrderDegrees=\"HigherOrderDegrees\">\n";
        write_array(out, "HigherOrderDegrees", 3, degrees, encoding);
        write_fields(out, mesh.cell_data, n_cells, encoding);
        out << "      </CellData>\n";
      });
  }



  void
  write_pvd(const std::string                                 &filename,
            const std::vector<std::pair<double, std::string>> &times_and_names)
  {
    // Not DataOutBase::write_pvd_record(): it puts the date into the file, so
    // that two equal runs would differ, and prints six digits, which merges
    // load times after many cuts.
    replace_file(filename, [&](std::ostream &out) {
      out.precision(std::numeric_limits<double>::digits10);
      out << "<?xml version=\"1.0\"?>\n"
          << "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\""
          << byte_order() << "\">\n  <Collection>\n";
      for (const auto &[time, name] : times_and_names)
        out << "    <DataSet timestep=\"" << time
            << "\" group=\"\" part=\"0\" file=\"" << escape_xml(name)
            << "\"/>\n";
      out << "  </Collection>\n</VTKFile>\n";
    });
  }
} // namespace NPT
