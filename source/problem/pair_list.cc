#include <deal.II/base/bounding_box.h>
#include <deal.II/base/mpi.h>

#include <mortise/base/error.h>
#include <mortise/base/quotes.h>
#include <mortise/base/text_table.h>
#include <mortise/body/mesh/facing_patches.h>
#include <mortise/output/whole_file.h>
#include <mortise/problem/mesh_request.h>
#include <mortise/problem/pair_list.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <limits>
#include <map>
#include <set>
#include <sstream>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Of a pair of bodies, slave and master.
    struct ProposedInterface
    {
      std::set<std::size_t> slaves, masters;
      bool                  apart = false;
    };
    using ProposedInterfaces =
      std::map<std::pair<std::size_t, std::size_t>, ProposedInterface>;

    double
    size_of(const MeshSurface &body)
    {
      const auto [low, high] =
        BoundingBox<3>(body.mesh.vertices).get_boundary_points();
      return low.distance(high);
    }

    std::string
    part_of(const MeshSurface &body)
    {
      return body.mesh.names.materials.begin()->second;
    }

    /// A name that a scene may have, of a part whose name may be anything.
    std::vector<std::string>
    names_of(const std::vector<MeshSurface> &bodies)
    {
      std::vector<std::string> names;
      for (const MeshSurface &body : bodies)
        {
          std::string name = part_of(body);
          for (char &c : name)
            if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '_' &&
                c != '-')
              c = '_';
          if (std::isdigit(static_cast<unsigned char>(name[0])) != 0)
            name = "part_" + name;
          while (std::count(names.begin(), names.end(), name) > 0)
            name += "_";
          names.push_back(name);
        }
      return names;
    }

    std::string
    face_name(const MeshSurface &body, const std::size_t patch)
    {
      return "face" + std::to_string(body.patches[patch].number);
    }

    std::string
    short_number(const double value)
    {
      std::ostringstream text;
      text.precision(4);
      text << value;
      return text.str();
    }

    /// Bodies touch where they are apart by no more than rounding.
    bool
    touches(const FacingPatches &pair, const double size)
    {
      return pair.largest_distance <= 1e-5 * size;
    }

    void
    join(std::string &list, const std::string &more)
    {
      list += (list.empty() ? "" : ", ") + more;
    }

    /// "name: face3, face7".
    std::string
    side_text(const std::string           &name,
              const MeshSurface           &body,
              const std::set<std::size_t> &patches)
    {
      std::string faces;
      for (const std::size_t patch : patches)
        join(faces, face_name(body, patch));
      return name + ": " + faces;
    }

    /// The parameters Boundaries and Curved boundaries for all that couples
    /// body
    /// @p b.
    std::string
    boundaries_text(const MeshSurface        &body,
                    const std::size_t         b,
                    const ProposedInterfaces &proposals)
    {
      std::set<std::size_t> used;
      for (const auto &[pair, proposal] : proposals)
        {
          if (pair.first == b)
            used.insert(proposal.slaves.begin(), proposal.slaves.end());
          if (pair.second == b)
            used.insert(proposal.masters.begin(), proposal.masters.end());
        }
      std::string names, shapes;
      for (const std::size_t p : used)
        {
          const SurfacePatch &patch = body.patches[p];
          const std::string   name  = face_name(body, p);
          names += (names.empty() ? "" : "; ") + name + ": faces " +
                   std::to_string(patch.number);
          if (patch.radius > 0.)
            shapes += (shapes.empty() ? "" : "; ") + name + ": " + patch.kind;
        }
      return (names.empty() ? "" : "    set Boundaries = " + names + "\n") +
             (shapes.empty() ? "" :
                               "    set Curved boundaries = " + shapes + "\n");
    }

    std::string
    body_text(const std::string    &name,
              const MeshParameters &mesh,
              const std::string    &part,
              const std::string    &boundaries)
    {
      std::ostringstream text;
      text << "\nsubsection Body " << name
           << "\n  set Degree = 2\n  subsection Mesh\n    set Source     = file"
              "\n    set File       = "
           << mesh.file << "\n    set Part       = " << part << "\n";
      if (mesh.mesh_size > 0.)
        text << "    set Mesh size  = " << mesh.mesh_size << "\n";
      text
        << boundaries
        << "  end\n  subsection Material\n    set Young modulus = 210e3  # an "
           "example\n    set Poisson ratio = 0.3\n  end\nend\n";
      return text.str();
    }

    std::string
    scene_text(const MeshParameters           &mesh,
               const std::vector<MeshSurface> &bodies,
               const ProposedInterfaces       &proposals,
               const double                    reach)
    {
      const auto  names = names_of(bodies);
      std::string all, interfaces, parts, laws;
      for (std::size_t b = 0; b < bodies.size(); ++b)
        {
          join(all, names[b]);
          parts += body_text(names[b],
                             mesh,
                             part_of(bodies[b]),
                             boundaries_text(bodies[b], b, proposals));
        }
      for (const auto &[pair, proposal] : proposals)
        {
          const auto [s, m]      = pair;
          const std::string name = names[s] + "-" + names[m];
          join(interfaces, name);
          laws += "\nsubsection Interface " + name + "\n  set Slave  = " +
                  side_text(names[s], bodies[s], proposal.slaves) +
                  "\n  set Master = " +
                  side_text(names[m], bodies[m], proposal.masters) +
                  "\n  set Law    = " +
                  (proposal.apart ? "contact\n  set Search distance = " +
                                      short_number(2. * reach) :
                                    "tie") +
                  "\nend\n";
        }
      return "# Made by mortise --pairs " + mesh.file +
             ". Materials, supports and loads are yours to give;\n# mortise "
             "--boundaries " +
             mesh.file + " lists the faces.\nset Bodies     = " + all +
             "\nset Interfaces = " + interfaces + "\n" + parts + laws;
    }

    std::string
    table_of(const std::vector<MeshSurface>   &bodies,
             const std::vector<FacingPatches> &pairs)
    {
      std::vector<std::vector<std::string>> rows = {{"slave",
                                                     "face",
                                                     "shape",
                                                     "master",
                                                     "face",
                                                     "shape",
                                                     "area",
                                                     "least distance",
                                                     "mean",
                                                     "largest"}};
      for (const FacingPatches &pair : pairs)
        {
          const MeshSurface  &slave_body  = bodies[pair.slave_body];
          const MeshSurface  &master_body = bodies[pair.master_body];
          const SurfacePatch &slave       = slave_body.patches[pair.slave];
          const SurfacePatch &master      = master_body.patches[pair.master];
          const auto          distance    = [&](const double value) {
            return short_number(value < 1e-9 * size_of(slave_body) ? 0. :
                                                                     value);
          };
          rows.push_back({part_of(slave_body),
                          std::to_string(slave.number),
                          slave.text(),
                          part_of(master_body),
                          std::to_string(master.number),
                          master.text(),
                          short_number(pair.area),
                          distance(pair.least_distance),
                          distance(pair.mean_distance),
                          distance(pair.largest_distance)});
        }
      return text_table(rows, false);
    }

    ProposedInterfaces
    proposed_interfaces(const std::vector<FacingPatches> &pairs,
                        const double                      size)
    {
      ProposedInterfaces proposals;
      for (const FacingPatches &pair : pairs)
        {
          // one interface for two bodies, whichever face is the smaller one
          const bool exchanged =
            proposals.count({pair.master_body, pair.slave_body}) > 0;
          ProposedInterface &proposal =
            proposals[exchanged ?
                        std::make_pair(pair.master_body, pair.slave_body) :
                        std::make_pair(pair.slave_body, pair.master_body)];
          proposal.slaves.insert(exchanged ? pair.master : pair.slave);
          proposal.masters.insert(exchanged ? pair.slave : pair.master);
          proposal.apart = proposal.apart || !touches(pair, size);
        }
      return proposals;
    }
  } // namespace

  std::string
  list_pairs(const std::string &file,
             const Settings    &settings,
             const MPI_Comm     comm)
  {
    const MeshRequest request = read_mesh_request("--pairs", file, settings);
    const std::string scene =
      (std::filesystem::path(request.directory) /
       (std::filesystem::path(file).stem().string() + ".prm"))
        .string();
    std::string problem, text, table;
    if (Utilities::MPI::this_mpi_process(comm) == 0)
      try
        {
          std::error_code none;
          if (std::filesystem::exists(scene, none))
            throw InputError("--pairs would write " + file_in_quotes(scene) +
                             ", which is there already; allowed: another "
                             "directory by --output");
          const auto bodies = read_parts(request.mesh, "--pairs");
          double     size   = std::numeric_limits<double>::max();
          for (const MeshSurface &body : bodies)
            size = std::min(size, size_of(body));
          const double reach =
            request.search_distance > 0. ? request.search_distance : size / 50.;
          const auto pairs = facing_patches(bodies, reach);
          table            = std::to_string(bodies.size()) +
                  " bodies; faces that are at most " + short_number(reach) +
                  " apart:\n\n" + table_of(bodies, pairs);
          text = scene_text(request.mesh,
                            bodies,
                            proposed_interfaces(pairs, size),
                            reach);
        }
      catch (const InputError &error)
        {
          problem = error.what();
        }
    throw_if_any(problem, comm);
    write_whole_file(scene, text, comm);
    return table + "\nA scene to begin with: " + scene + "\n";
  }
} // namespace mortise
