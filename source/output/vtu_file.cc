#include <deal.II/base/mpi.h>

#include <mortise/output/vtu_file.h>
#include <mortise/output/whole_file.h>
#include <zlib.h>

#include <algorithm>
#include <numeric>
#include <type_traits>

namespace mortise
{
  using namespace dealii;

  void
  VtuPiece::begin_cell(const LagrangeShape shape, const unsigned int degree)
  {
    types.push_back(vtk_type(shape, degree));
    offsets.push_back(points.size() / 3 + lagrange_nodes(shape, degree).size());
  }

  namespace
  {
    /// Bytes that are compressed at a time: a reader's cache holds them, and
    /// the sizes in the header stay small.
    constexpr std::size_t block_size = 1 << 20;

    void
    append_number(const std::uint32_t number, std::vector<unsigned char> &bytes)
    {
      const auto *first = reinterpret_cast<const unsigned char *>(&number);
      bytes.insert(bytes.end(), first, first + sizeof(number));
    }

    /// In base 64, several times as fast as that of deal.II.
    std::string
    base_64(const std::vector<unsigned char> &bytes)
    {
      constexpr char digits[] =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
      std::string text((bytes.size() + 2) / 3 * 4, '=');
      for (std::size_t i = 0, k = 0; i < bytes.size(); i += 3, k += 4)
        {
          const std::size_t n    = std::min<std::size_t>(3, bytes.size() - i);
          std::uint32_t     bits = bytes[i] << 16;
          if (n > 1)
            bits |= bytes[i + 1] << 8;
          if (n > 2)
            bits |= bytes[i + 2];
          for (unsigned int d = 0; d <= n; ++d)
            text[k + d] = digits[(bits >> (18 - 6 * d)) & 63];
        }
      return text;
    }

    /// As VTK has compressed data: number of blocks, size of a block, size of
    /// the last one if it is smaller, compressed sizes; then the blocks.
    std::string
    encode(const unsigned char *data, const std::size_t size, const int level)
    {
      const std::size_t n_blocks = (size + block_size - 1) / block_size;
      std::vector<unsigned char> header,
        blocks(compressBound(block_size) * n_blocks);
      append_number(n_blocks, header);
      append_number(block_size, header);
      append_number(size % block_size, header);
      std::size_t used = 0;
      for (std::size_t start = 0; start < size; start += block_size)
        {
          uLongf    length = blocks.size() - used;
          const int status = compress2(&blocks[used],
                                       &length,
                                       data + start,
                                       std::min(block_size, size - start),
                                       level);
          AssertThrow(status == Z_OK, ExcOutOfMemory(blocks.size()));
          append_number(length, header);
          used += length;
        }
      blocks.resize(used);
      return base_64(header) + base_64(blocks);
    }

    template <typename Number>
    std::string
    array(const std::string         &name,
          const unsigned int         n_components,
          const std::vector<Number> &values)
    {
      // values of fields hardly repeat: to compress them takes longer than to
      // write them
      const int level =
        std::is_same<Number, float>::value ? Z_NO_COMPRESSION : Z_BEST_SPEED;
      const std::string type = std::is_same<Number, double>::value ? "Float64" :
                               std::is_same<Number, float>::value  ? "Float32" :
                               std::is_same<Number, std::int32_t>::value ?
                                                                    "Int32" :
                                                                    "UInt8";
      return "<DataArray type=\"" + type + "\" Name=\"" + name +
             "\" NumberOfComponents=\"" + std::to_string(n_components) +
             "\" format=\"binary\">\n" +
             encode(reinterpret_cast<const unsigned char *>(values.data()),
                    values.size() * sizeof(Number),
                    level) +
             "\n</DataArray>\n";
    }

    std::string
    fields(const std::string &element, const std::vector<VtuField> &all)
    {
      std::string text = "<" + element + ">\n";
      for (const VtuField &field : all)
        text += array(field.name, field.n_components, field.values);
      return text + "</" + element + ">\n";
    }

    std::string
    text_of(const VtuPiece &piece)
    {
      std::vector<std::int32_t> connectivity(piece.points.size() / 3);
      std::iota(connectivity.begin(), connectivity.end(), 0);
      return "<Piece NumberOfPoints=\"" + std::to_string(connectivity.size()) +
             "\" NumberOfCells=\"" + std::to_string(piece.types.size()) +
             "\">\n<Points>\n" + array("Points", 3, piece.points) +
             "</Points>\n<Cells>\n" + array("connectivity", 1, connectivity) +
             array("offsets", 1, piece.offsets) +
             array("types", 1, piece.types) + "</Cells>\n" +
             fields("PointData", piece.of_points) +
             fields("CellData", piece.of_cells) + "</Piece>\n";
    }
  } // namespace

  // ParaView cannot bear a piece without cells, and no file without a piece.
  void
  write_vtu_file(const VtuPiece    &piece,
                 const std::string &file,
                 const MPI_Comm     comm)
  {
    const unsigned int me      = Utilities::MPI::this_mpi_process(comm),
                       n_ranks = Utilities::MPI::n_mpi_processes(comm);
    const bool has_cells       = !piece.types.empty(),
               none = Utilities::MPI::max(has_cells ? 1 : 0, comm) == 0;
    std::string text;
    if (me == 0)
      text =
        "<?xml version=\"1.0\"?>\n"
        "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
        "compressor=\"vtkZLibDataCompressor\" byte_order=\"LittleEndian\">\n"
        "<UnstructuredGrid>\n";
    if (has_cells || (none && me == 0))
      text += text_of(piece);
    if (me == n_ranks - 1)
      text += "</UnstructuredGrid>\n</VTKFile>\n";
    write_whole_file(file, text, comm);
  }
} // namespace mortise
