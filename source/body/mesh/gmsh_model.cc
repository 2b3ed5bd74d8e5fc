#include <deal.II/base/utilities.h>

#include <boost/serialization/map.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/utility.hpp>
#include <boost/serialization/vector.hpp>

#include <gmsh.h>
#include <mortise/base/child_process.h>
#include <mortise/body/mesh/gmsh_model.h>

#include <algorithm>
#include <cctype>
#include <set>
#include <sstream>
#include <stdexcept>
#include <type_traits>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    std::string
    extension(const std::string &file_name)
    {
      const std::size_t dot = file_name.rfind('.');
      std::string       end =
        dot == std::string::npos ? "" : file_name.substr(dot + 1);
      std::transform(end.begin(), end.end(), end.begin(), [](unsigned char c) {
        return std::tolower(c);
      });
      return end;
    }

    bool
    is_cad_file(const std::string &file_name)
    {
      const std::string end = extension(file_name);
      return end == "step" || end == "stp" || end == "brep";
    }

    /// The library, from first to last use. It has one state for the whole
    /// process.
    class Session
    {
    public:
      explicit Session(const double mesh_size)
      {
        std::ostringstream number;
        number.precision(17);
        number << mesh_size;
        std::vector<std::string> words = {"mortise", "-nopopup"};
        if (mesh_size > 0.)
          words.insert(words.end(), {"-setnumber", "mesh_size", number.str()});
        std::vector<char *> arguments;
        for (std::string &word : words)
          arguments.push_back(&word[0]);
        gmsh::initialize(arguments.size(), arguments.data(), false);
        gmsh::option::setNumber("General.Terminal", 0);
        gmsh::option::setNumber("General.NumThreads", 1);
        gmsh::logger::start();
      }

      ~Session()
      {
        try
          {
            gmsh::logger::stop();
            gmsh::finalize();
          }
        catch (...)
          {} // nothing is lost: all data have been copied
      }

      Session(const Session &) = delete;
      Session &
      operator=(const Session &) = delete;

      /// The first error that the library has met; empty if none.
      std::string
      error() const
      {
        std::vector<std::string> lines;
        gmsh::logger::get(lines);
        for (const std::string &line : lines)
          if (line.compare(0, 7, "Error: ") == 0)
            return line.substr(7);
        return {};
      }
    };

    GmshElements
    describe(const int type)
    {
      GmshElements        block;
      int                 d = 0, order = 0, n_nodes = 0, n_vertices = 0;
      std::vector<double> positions;
      gmsh::model::mesh::getElementProperties(
        type, block.type, d, order, n_nodes, positions, n_vertices);
      block.dimension  = d;
      block.order      = order;
      block.n_vertices = n_vertices;
      for (int i = 0; i < n_nodes; ++i)
        {
          Point<3> x;
          for (int c = 0; c < d; ++c)
            x[c] = positions[d * i + c];
          block.reference.push_back(x);
        }
      return block;
    }

    /// Groups named by their tags where they have no name.
    std::map<int, std::string>
    names(const int dimension)
    {
      std::map<int, std::string> result;
      gmsh::vectorpair           groups;
      gmsh::model::getPhysicalGroups(groups, dimension);
      for (const auto &group : groups)
        {
          std::string name;
          gmsh::model::getPhysicalName(dimension, group.second, name);
          result[group.second] =
            name.empty() ? std::to_string(group.second) : name;
        }
      return result;
    }

    /// Where there are no physical groups every entity is one, volumes with the
    /// name that a CAD file gives them. False: there are groups.
    bool
    group_entities(const int dimension)
    {
      gmsh::vectorpair entities, groups;
      gmsh::model::getPhysicalGroups(groups, dimension);
      if (!groups.empty())
        return false;
      gmsh::model::getEntities(entities, dimension);
      std::set<std::string> known;
      for (const auto &entity : entities)
        {
          gmsh::model::addPhysicalGroup(dimension,
                                        {entity.second},
                                        entity.second);
          std::string name; // "Shapes/assembly/part"
          gmsh::model::getEntityName(dimension, entity.second, name);
          name = name.substr(name.rfind('/') + 1);
          if (dimension == 3 && !name.empty() && known.insert(name).second)
            gmsh::model::setPhysicalName(dimension, entity.second, name);
        }
      return true;
    }

    /// Nodes of @p model and the place of each tag.
    std::vector<unsigned int>
    read_nodes(GmshModel &model)
    {
      std::vector<std::size_t> tags;
      std::vector<double>      coordinates, parameters;
      gmsh::model::mesh::getNodes(tags, coordinates, parameters);
      std::size_t largest = 0;
      for (const std::size_t tag : tags)
        largest = std::max(largest, tag);
      if (largest > 100 * tags.size() + 1000000)
        throw std::runtime_error("the tags of nodes are spread up to " +
                                 std::to_string(largest));
      std::vector<unsigned int> place(largest + 1,
                                      numbers::invalid_unsigned_int);
      for (std::size_t i = 0; i < tags.size(); ++i)
        {
          if (place[tags[i]] != numbers::invalid_unsigned_int)
            continue;
          place[tags[i]] = model.nodes.size();
          model.node_tags.push_back(tags[i]);
          model.nodes.emplace_back(coordinates[3 * i],
                                   coordinates[3 * i + 1],
                                   coordinates[3 * i + 2]);
        }
      return place;
    }

    void
    read_elements(const int                        dimension,
                  const std::vector<unsigned int> &place,
                  GmshModel                       &model)
    {
      gmsh::vectorpair entities;
      gmsh::model::getEntities(entities, dimension);
      for (const auto &entity : entities)
        {
          std::vector<int>                      types;
          std::vector<std::vector<std::size_t>> tags, nodes;
          gmsh::model::mesh::getElements(
            types, tags, nodes, dimension, entity.second);
          for (unsigned int t = 0; t < types.size(); ++t)
            {
              GmshElements block = describe(types[t]);
              block.tags         = tags[t];
              gmsh::model::getPhysicalGroupsForEntity(dimension,
                                                      entity.second,
                                                      block.groups);
              for (int &group : block.groups)
                group = std::abs(group); // a sign is an orientation
              std::sort(block.groups.begin(), block.groups.end());
              for (const std::size_t tag : nodes[t])
                {
                  if (tag >= place.size() ||
                      place[tag] == numbers::invalid_unsigned_int)
                    throw std::runtime_error("an element has the node " +
                                             std::to_string(tag) +
                                             ", which is not in the file");
                  block.nodes.push_back(place[tag]);
                }
              model.elements.push_back(block);
            }
        }
    }

    GmshModel
    mesh(const std::string &file_name,
         const double       mesh_size,
         const SizeField   *sizes)
    {
      gmsh::open(file_name);
      GmshModel model;
      model.surfaces_of_geometry =
        group_entities(2) && is_geometry_file(file_name);
      group_entities(3);
      if (mesh_size > 0.)
        gmsh::option::setNumber("Mesh.MeshSizeMax", mesh_size);
      if (sizes != nullptr)
        {
          // gmsh takes the least size itself, from 4.9 on it passes the
          // one that it would take
          const auto least =
            [sizes](int, int, double x, double y, double z, auto... other) {
              return std::min({(*sizes)(Point<3>(x, y, z)), other...});
            };
          using Least = decltype(least);
          static_assert(std::is_invocable_r_v<double,
                                              Least,
                                              int,
                                              int,
                                              double,
                                              double,
                                              double> &&
                          std::is_invocable_r_v<double,
                                                Least,
                                                int,
                                                int,
                                                double,
                                                double,
                                                double,
                                                double>,
                        "callbacks of both versions of gmsh");
          gmsh::model::mesh::setSizeCallback(least);
        }
      if (is_geometry_file(file_name))
        gmsh::model::mesh::generate(3);
      model.surface_names                   = names(2);
      model.volume_names                    = names(3);
      const std::vector<unsigned int> place = read_nodes(model);
      read_elements(2, place, model);
      read_elements(3, place, model);
      return model;
    }
  } // namespace

  bool
  is_geometry_file(const std::string &file_name)
  {
    return extension(file_name) == "geo" || is_cad_file(file_name);
  }

  bool
  is_foreign_mesh_file(const std::string &file_name)
  {
    const std::string end = extension(file_name);
    return end == "unv" || end == "bdf" || end == "nas" || end == "vtk";
  }

  GmshElements
  describe_gmsh_elements(const int type)
  {
    const Session session(0.);
    return describe(type);
  }

  namespace
  {
    /// Problem (none: empty) and mesh.
    using Answer = std::pair<std::string, GmshModel>;

    Answer
    try_to_mesh(const std::string &file_name,
                const double       mesh_size,
                const SizeField   *sizes)
    {
      const Session session(mesh_size);
      Answer        answer;
      try
        {
          answer.second = mesh(file_name, mesh_size, sizes);
        }
      catch (const std::exception &error)
        {
          answer.first = error.what();
        }
      catch (const std::string &error) // of the library
        {
          answer.first = error;
        }
      catch (...)
        {
          answer.first = "unknown";
        }
      const std::string first = session.error();
      if (!first.empty())
        answer.first = first;
      return answer;
    }
  } // namespace

  GmshModel
  mesh_geometry(const std::string &file_name,
                const double       mesh_size,
                const SizeField   *sizes)
  {
    Answer answer = Utilities::unpack<Answer>(
      in_child_process([&] {
        return Utilities::pack(try_to_mesh(file_name, mesh_size, sizes), false);
      }),
      false);
    if (!answer.first.empty())
      throw std::runtime_error(answer.first);
    return std::move(answer.second);
  }
} // namespace mortise
