#include <mortise/body/mesh/inp_shapes.h>

#include <cctype>
#include <cstdlib>
#include <map>

namespace mortise
{
  using namespace dealii;

  const InpShape &
  inp_shape(const unsigned int n_vertices)
  {
    static const InpShape tetrahedron = {
      "Tetrahedron",
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
      {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}},
      {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}}};
    static const InpShape pyramid = {
      "Pyramid",
      {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {0, 0, 1}},
      {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}},
      {{0, 1, 2, 3}, {0, 4, 1}, {1, 4, 2}, {2, 4, 3}, {3, 4, 0}}};
    static const InpShape wedge = {
      "Prism",
      {{0, 0, -1}, {1, 0, -1}, {0, 1, -1}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}},
      {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}},
      {{0, 1, 2}, {3, 5, 4}, {0, 3, 4, 1}, {1, 4, 5, 2}, {2, 5, 3, 0}}};
    static const InpShape hexahedron = {"Hexahedron",
                                        {{-1, -1, -1},
                                         {1, -1, -1},
                                         {1, 1, -1},
                                         {-1, 1, -1},
                                         {-1, -1, 1},
                                         {1, -1, 1},
                                         {1, 1, 1},
                                         {-1, 1, 1}},
                                        {{0, 1},
                                         {1, 2},
                                         {2, 3},
                                         {3, 0},
                                         {4, 5},
                                         {5, 6},
                                         {6, 7},
                                         {7, 4},
                                         {0, 4},
                                         {1, 5},
                                         {2, 6},
                                         {3, 7}},
                                        {{0, 1, 2, 3},
                                         {4, 7, 6, 5},
                                         {0, 4, 5, 1},
                                         {1, 5, 6, 2},
                                         {2, 6, 7, 3},
                                         {3, 7, 4, 0}}};
    return n_vertices == 4 ? tetrahedron :
           n_vertices == 5 ? pyramid :
           n_vertices == 6 ? wedge :
                             hexahedron;
  }

  InpType
  inp_type(const std::string &name)
  {
    static const std::map<unsigned int, unsigned int> solid = {
      {4, 4}, {10, 4}, {6, 6}, {15, 6}, {8, 8}, {20, 8}};
    static const std::map<unsigned int, unsigned int> flat = {{3, 3},
                                                              {6, 3},
                                                              {4, 4},
                                                              {8, 4}};
    for (const std::string start : {"C3D", "CPS", "CPE", "SFM3D", "M3D", "S"})
      if (name.compare(0, start.size(), start) == 0 &&
          name.size() > start.size() &&
          std::isdigit(static_cast<unsigned char>(name[start.size()])) != 0)
        {
          InpType type;
          type.dimension     = start == "C3D" ? 3 : 2;
          type.n_nodes       = std::atoi(name.c_str() + start.size());
          const auto &shapes = type.dimension == 3 ? solid : flat;
          if (shapes.count(type.n_nodes) > 0)
            type.n_vertices = shapes.at(type.n_nodes);
          return type;
        }
    return {};
  }
} // namespace mortise
