// Proves that a checkpoint gives every number back bit for bit, whatever the
// numbers of ranks that write and read it, on hexahedra of generators and of
// files with hanging nodes and several degrees, on tetrahedra of both, with
// pressures, and where ranks own no cells; that each number is in the file
// once; that damaged files and those of other versions and scenes are refused
// with what differs.
#include <boost/crc.hpp>

#include <mortise/output/checkpoint.h>
#include <mortise/output/checkpoint_records.h>
#include <mortise/output/summary.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <map>
#include <random>

#include "../body/gmsh_meshes.h"
#include "../scenes/scene.h"

using namespace mortise;
using namespace dealii;
using mortise::testing::verdict;

namespace
{
  struct GivenBody
  {
    std::string                                name;
    MeshParameters                             mesh;
    unsigned int                               degree = 2;
    bool                                       mixed  = false;
    std::map<types::material_id, unsigned int> regions{};
  };

  struct GivenInterface
  {
    std::string  name;
    unsigned int slave;
    std::string  slave_boundary;
    unsigned int master;
    std::string  master_boundary;
  };

  struct Given
  {
    std::vector<GivenBody>      bodies;
    std::vector<GivenInterface> interfaces;
  };

  /// Spread over a communicator, with interfaces that are not integrated.
  struct Scene
  {
    Scene(const Given &given, const MPI_Comm comm)
      : comm(comm)
    {
      std::vector<const DoFHandler<dim> *>   handlers;
      std::vector<AffineConstraints<double>> constraints(given.bodies.size());
      for (unsigned int b = 0; b < given.bodies.size(); ++b)
        {
          const GivenBody &own = given.bodies[b];
          bodies.push_back(std::make_unique<Body>(
            own.name, b, LinearElastic{1., 0.3, own.mixed}));
          bodies[b]->create_mesh(own.mesh, comm, own.name);
          bodies[b]->create_space(own.degree, own.regions, own.name);
          handlers.push_back(&bodies[b]->dof_handler);
          constraints[b].copy_from(bodies[b]->conformity);
        }
      const FieldNumbering numbering(handlers, comm);
      const auto           all = scene_constraints(numbering, constraints);
      const auto surface = [&](const unsigned int b, const std::string &name) {
        return extract_surface(*bodies[b],
                               bodies[b]->boundary_id(name, ""),
                               numbering,
                               all);
      };
      for (const GivenInterface &own : given.interfaces)
        {
          couplings.emplace_back();
          couplings.back().interface = std::make_unique<InterfaceHandler>(
            own.name,
            surface(own.slave, own.slave_boundary),
            surface(own.master, own.master_boundary),
            InterfaceOptions(),
            comm);
        }
    }

    MPI_Comm              comm;
    Bodies                bodies;
    std::vector<Coupling> couplings;
  };

  /// 64 bits drawn at random, NaN and infinity among them.
  double
  random_bits(std::mt19937_64 &random)
  {
    const std::uint64_t bits = random();
    double              value;
    std::memcpy(&value, &bits, sizeof(value));
    return value;
  }

  bool
  same_bits(const double a, const double b)
  {
    return std::memcmp(&a, &b, sizeof(double)) == 0;
  }

  std::vector<types::global_dof_index>
  dofs_of(const Body::CellIterator &cell)
  {
    std::vector<types::global_dof_index> dofs(cell->get_fe().n_dofs_per_cell());
    cell->get_dof_indices(dofs);
    return dofs;
  }

  using Face = std::tuple<unsigned int, CellId, unsigned int>;

  /// The same random values of a scene on every rank.
  class Truth
  {
  public:
    Truth(const Given &given)
      : serial(given, MPI_COMM_SELF)
    {
      std::mt19937_64 random(1);
      const auto      fill = [&](BodyVector &values, const auto &handler) {
        values.reinit(handler.n_dofs());
        for (double &value : values)
          value = random_bits(random);
      };
      state.solutions.resize(serial.bodies.size());
      cells.resize(serial.bodies.size());
      for (const auto &body : serial.bodies)
        {
          BodySolution &own = state.solutions[body->index];
          fill(own.displacement, body->dof_handler);
          if (body->pressure)
            fill(own.pressure, body->pressure->dof_handler);
          for (const auto &cell : body->dof_handler.active_cell_iterators())
            cells[body->index].emplace(cell->id(), cell);
        }
      for (unsigned int i = 0; i < serial.couplings.size(); ++i)
        {
          const BodySurface &slave = serial.couplings[i].interface->slave();
          state.multipliers.emplace_back();
          for (unsigned int s = 0; s < slave.faces.size(); ++s)
            {
              std::vector<double> values(dim * slave.traces[s].n_functions());
              for (double &value : values)
                value = random_bits(random);
              faces[{i, slave.cells[s]->id(), slave.face_numbers[s]}] = values;
              state.multipliers.back().push_back(values);
            }
        }
      state.text = std::string("{\"step\": 3}\0 end", 16);
    }

    /// Call @p take(dof, value) for each dof of each cell that @p scene knows, of one field of @p body.
    template <typename Take>
    void
    for_each_dof(const Body &body, const bool pressure, const Take &take) const
    {
      const Body         &own   = *serial.bodies[body.index];
      const BodySolution &truth = state.solutions[body.index];
      for (const auto &cell : body.dof_handler.active_cell_iterators())
        if (!cell->is_artificial())
          {
            const auto &of_truth = cells[body.index].at(cell->id());
            const auto  dofs =
              dofs_of(pressure ? body.pressure->cell(cell) : cell);
            const auto own_dofs =
              dofs_of(pressure ? own.pressure->cell(of_truth) : of_truth);
            AssertThrow(dofs.size() == own_dofs.size(), ExcInternalError());
            for (unsigned int i = 0; i < dofs.size(); ++i)
              take(dofs[i],
                   (pressure ? truth.pressure :
                               truth.displacement)(own_dofs[i]));
          }
    }

    /// The same values spread as @p scene is.
    Checkpoint
    spread(const Scene &scene) const
    {
      Checkpoint result;
      result.text = state.text;
      result.solutions.resize(scene.bodies.size());
      for (const auto &body : scene.bodies)
        for (const bool pressure : {false, true})
          if (!pressure || body->pressure)
            {
              BodySolution &own    = result.solutions[body->index];
              BodyVector   &values = pressure ? own.pressure : own.displacement;
              const auto   &handler =
                pressure ? body->pressure->dof_handler : body->dof_handler;
              values.reinit(handler.locally_owned_dofs(),
                            pressure ? body->pressure->relevant_dofs :
                                       body->relevant_dofs,
                            scene.comm);
              for_each_dof(*body,
                           pressure,
                           [&](const auto dof, const double value) {
                             if (values.in_local_range(dof))
                               values(dof) = value;
                           });
              values.update_ghost_values();
            }
      for (unsigned int i = 0; i < scene.couplings.size(); ++i)
        {
          const BodySurface &slave = scene.couplings[i].interface->slave();
          result.multipliers.emplace_back();
          for (unsigned int s = 0; s < slave.faces.size(); ++s)
            result.multipliers.back().push_back(
              faces.at({i, slave.cells[s]->id(), slave.face_numbers[s]}));
        }
      return result;
    }

    /// Values of this rank, ghosts among them, that are not as they should be.
    unsigned int
    n_wrong(const Scene &scene, const Checkpoint &checkpoint) const
    {
      unsigned int sum = checkpoint.text != state.text;
      for (const auto &body : scene.bodies)
        for (const bool pressure : {false, true})
          if (!pressure || body->pressure)
            {
              const BodySolution &own = checkpoint.solutions[body->index];
              const BodyVector   &values =
                pressure ? own.pressure : own.displacement;
              for_each_dof(*body,
                           pressure,
                           [&](const auto dof, const double value) {
                             sum += !same_bits(values(dof), value);
                           });
            }
      for (unsigned int i = 0; i < scene.couplings.size(); ++i)
        {
          const BodySurface &slave = scene.couplings[i].interface->slave();
          sum += checkpoint.multipliers[i].size() != slave.faces.size();
          for (unsigned int s = 0; s < slave.faces.size(); ++s)
            {
              const auto &got = checkpoint.multipliers[i][s];
              const auto &expected =
                faces.at({i, slave.cells[s]->id(), slave.face_numbers[s]});
              sum += !std::equal(got.begin(),
                                 got.end(),
                                 expected.begin(),
                                 expected.end(),
                                 same_bits);
            }
        }
      return sum;
    }

    const std::string &
    text() const
    {
      return state.text;
    }

  private:
    Scene                                             serial;
    Checkpoint                                        state;
    std::vector<std::map<CellId, Body::CellIterator>> cells; ///< by body
    std::map<Face, std::vector<double>>               faces;
  };

  /// A cube of tetrahedra, or of 2 x 2 x 3 second-order hexahedra.
  std::string
  gmsh_mesh(const bool hexahedra)
  {
    const std::string square = R"(
Point(1) = {0, 0, 0, 0.5};
Point(2) = {1, 0, 0, 0.5};
Point(3) = {1, 1, 0, 0.5};
Point(4) = {0, 1, 0, 0.5};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
)";
    const std::string layers = hexahedra ? R"(
Transfinite Curve{1, 2, 3, 4} = 3;
Transfinite Surface{1};
Recombine Surface{1};
out[] = Extrude {0, 0, 1} {Surface{1}; Layers{3}; Recombine;};
)" :
                                           R"(
out[] = Extrude {0, 0, 1} {Surface{1};};
)";
    const std::string names  = R"(
Physical Volume("solid") = {out[1]};
Physical Surface("bottom") = {1};
Physical Surface("top") = {out[0]};
Physical Surface("side") = {out[2]};
)";
    gmsh_test::Format format;
    format.version = 2.2;
    format.order   = hexahedra ? 2 : 1;
    return gmsh_test::write_mesh(hexahedra ? "checkpoint_hexahedra" :
                                             "checkpoint_tetrahedra",
                                 square + layers + names,
                                 format);
  }

  MeshParameters
  box(const std::vector<double>       &extent,
      const std::vector<unsigned int> &subdivisions)
  {
    MeshParameters mesh;
    mesh.extent       = extent;
    mesh.subdivisions = subdivisions;
    return mesh;
  }

  enum : unsigned int
  {
    inner, ///< curved hexahedra, hanging nodes, degrees by region, pressures
    outer, ///< curved tetrahedra, degrees by region, pressures
    block, ///< tetrahedra of a file
    solid, ///< second-order hexahedra of a file
    brick, ///< one cell
    bar    ///< two cells of different degrees
  };

  Given
  given_scene()
  {
    MeshParameters shell;
    shell.source       = "shell octant";
    shell.extent       = {1., 1.5};
    shell.subdivisions = {2, 1};
    shell.refine_near  = "0, 0, 1.5, 0.4, 1";
    MeshParameters cover;
    cover.source              = "shell octant";
    cover.extent              = {1.5, 2.};
    cover.subdivisions        = {2, 1};
    cover.cells               = "tetrahedra";
    MeshParameters tetrahedra = gmsh_test::file_parameters(gmsh_mesh(false));
    tetrahedra.translate      = {{10., 0., 0.}};
    MeshParameters hexahedra  = gmsh_test::file_parameters(gmsh_mesh(true));
    hexahedra.translate       = {{20., 0., 0.}};
    return {{{"inner", shell, 2, true, {{0, 2}, {1, 4}, {2, 3}}},
             {"outer", cover, 2, true, {{0, 3}, {1, 2}, {2, 4}}},
             {"block", tetrahedra, 3},
             {"solid", hexahedra, 2},
             {"brick", box({10., 0., 1., 11., 1., 2.}, {1, 1, 1}), 1},
             {"bar",
              box({0., 0., 5., 2., 1., 6.}, {2, 1, 1}),
              2,
              false,
              {{0, 2}, {1, 3}}}},
            {{"glue", inner, "outside", outer, "inside"},
             {"seam", block, "top", brick, "zmin"}}};
  }

  std::string
  message_of(const std::function<void()> &action)
  {
    try
      {
        action();
      }
    catch (const InputError &error)
      {
        return error.what();
      }
    return "(no error)";
  }

  /// On all ranks the same message, with all @p fragments.
  void
  check_message(const std::string              &what,
                const std::string              &message,
                const std::vector<std::string> &fragments)
  {
    bool good =
      message == Utilities::MPI::broadcast(MPI_COMM_WORLD, message, 0);
    for (const std::string &fragment : fragments)
      good = good && message.find(fragment) != std::string::npos;
    good = Utilities::MPI::min<int>(good, MPI_COMM_WORLD);
    verdict(what + (good ? "" : ": \"" + message + "\""), !good, 0);
  }

  /// Some of the ranks of the world.
  struct Group
  {
    std::string name;
    MPI_Comm    comm;
    bool        member;
  };

  std::vector<Group>
  groups()
  {
    const unsigned int me = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
    const unsigned int n  = Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
    const bool         in = me < std::max(n - 1, 1u);
    MPI_Comm           fewer;
    MPI_Comm_split(MPI_COMM_WORLD, in, me, &fewer);
    return {{"one rank", MPI_COMM_SELF, me == 0},
            {"all ranks but one", fewer, in},
            {"all ranks", MPI_COMM_WORLD, true}};
  }

  const std::string &
  directory()
  {
    static const std::string name = gmsh_test::own_name("checkpoints");
    return name;
  }

  std::string
  file()
  {
    return checkpoint_file_name(directory());
  }

  void
  test_ranks(const Given &given, const Truth &truth)
  {
    const std::vector<Group>            all = groups();
    std::vector<std::unique_ptr<Scene>> scenes;
    for (const Group &group : all)
      scenes.push_back(std::make_unique<Scene>(given, group.comm));
    std::uint64_t size = 0;
    for (unsigned int w = 0; w < all.size(); ++w)
      {
        if (all[w].member)
          write_checkpoint(directory(),
                           truth.spread(*scenes[w]),
                           scenes[w]->bodies,
                           scenes[w]->couplings,
                           all[w].comm);
        MPI_Barrier(MPI_COMM_WORLD);
        const auto of_values =
          std::filesystem::file_size(file()) -
          16 * Utilities::MPI::broadcast(MPI_COMM_WORLD,
                                         Utilities::MPI::n_mpi_processes(
                                           all[w].comm),
                                         0);
        size = w == 0 ? of_values : size;
        verdict("written by " + all[w].name + ": each value once",
                of_values != size,
                0);
        for (unsigned int r = 0; r < all.size(); ++r)
          {
            unsigned int n_wrong = 0;
            if (all[r].member)
              n_wrong = truth.n_wrong(*scenes[r],
                                      read_checkpoint(directory(),
                                                      scenes[r]->bodies,
                                                      scenes[r]->couplings,
                                                      all[r].comm));
            verdict("written by " + all[w].name + ", read by " + all[r].name,
                    Utilities::MPI::sum(n_wrong, MPI_COMM_WORLD),
                    0);
          }
      }
    const std::filesystem::directory_iterator files(directory());
    verdict("no other file is left",
            std::distance(begin(files), end(files)) - 1,
            0);
    check_message("a directory that is a file",
                  message_of([&] {
                    write_checkpoint(file(),
                                     truth.spread(*scenes.back()),
                                     scenes.back()->bodies,
                                     scenes.back()->couplings,
                                     MPI_COMM_WORLD);
                  }),
                  {"cannot write"});
    MPI_Comm fewer = all[1].comm;
    scenes.clear();
    MPI_Comm_free(&fewer);
  }

  /// Files are longer than a block only when they are large.
  void
  test_blocks(const Given &given, const Truth &truth)
  {
    const Scene       scene(given, MPI_COMM_SELF);
    const std::string records =
      pack_records(truth.spread(scene), scene.bodies, scene.couplings);
    for (const std::size_t size : {1, 5, 777, 100000})
      {
        RecordReader reader(scene.bodies, scene.couplings);
        for (std::size_t start = 0; start < records.size(); start += size)
          reader.take(records.substr(start, size));
        const std::string problem = reader.finish();
        Checkpoint        got     = reader.result();
        got.text                  = truth.text();
        verdict("records in blocks of " + std::to_string(size) + " bytes" +
                  (problem.empty() ? "" : ": " + problem),
                truth.n_wrong(scene, got) + !problem.empty(),
                0);
      }
    RecordReader reader(scene.bodies, scene.couplings);
    reader.take(records.substr(0, records.size() - 1));
    check_message("records that end too early",
                  reader.finish(),
                  {"interface \"seam\" has no values"});
  }

  /// Rank 0 puts @p content in the place of the checkpoint.
  void
  replace(const std::string &content)
  {
    MPI_Barrier(MPI_COMM_WORLD);
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::ofstream(file(), std::ios::binary | std::ios::trunc) << content;
    MPI_Barrier(MPI_COMM_WORLD);
  }

  /// Text and all of the file with @p content are refused with @p fragments.
  void
  check_refused(const std::string              &what,
                const Scene                    &scene,
                const std::string              &content,
                const std::vector<std::string> &fragments)
  {
    replace(content);
    const std::string message =
      message_of([] { read_checkpoint_text(directory(), MPI_COMM_WORLD); });
    check_message(what, message, fragments);
    verdict(what + ": the same without and with a scene",
            message != message_of([&] {
              read_checkpoint(directory(),
                              scene.bodies,
                              scene.couplings,
                              MPI_COMM_WORLD);
            }),
            0);
  }

  constexpr std::size_t checksum_place = 16, format_place = 24,
                        version_place = 48;

  /// @p content with the checksum of its header.
  std::string
  with_checksum(std::string content)
  {
    std::uint64_t header;
    std::memcpy(&header, content.data() + format_place + 8, 8);
    boost::crc_32_type crc;
    crc.process_bytes(content.data() + format_place, 16 + header);
    const std::uint64_t checksum = crc.checksum();
    std::memcpy(content.data() + checksum_place, &checksum, 8);
    return content;
  }

  void
  test_damage(const Scene &scene, const std::string &good)
  {
    std::uint64_t header;
    std::memcpy(&header, good.data() + format_place + 8, 8);
    const std::size_t start = format_place + 16 + header;
    for (const auto &[name, size] :
         std::vector<std::pair<std::string, std::size_t>>{
           {"nothing", 0},
           {"one byte", 1},
           {"all but one byte of the start", format_place + 15},
           {"the start", format_place + 16},
           {"half of the header", start / 2},
           {"all of the header", start},
           {"one byte of the values", start + 1},
           {"half of the file", good.size() / 2},
           {"all but one byte", good.size() - 1}})
      check_refused("truncated, left is " + name,
                    scene,
                    good.substr(0, size),
                    {"damaged",
                     size < start ?
                       "ends after " + std::to_string(size) :
                       std::to_string(size) + " bytes instead of " +
                         std::to_string(good.size())});
    check_refused("a byte too many", scene, good + "x", {"bytes instead of"});
    std::string zeros = good;
    std::fill(zeros.end() - 100, zeros.end(), '\0');
    check_refused("zeros at the end",
                  scene,
                  zeros,
                  {"damaged", "values", "do not match their checksum"});

    std::mt19937 random(2);
    unsigned int n_missed = 0, n_silent = 0;
    for (unsigned int i = 0; i < 400; ++i)
      {
        std::string content = good;
        // half of them in the header
        content[random() % (i % 2 ? start : good.size())] ^=
          static_cast<char>(1 + random() % 255);
        replace(content);
        const std::string message =
          message_of([] { read_checkpoint_text(directory(), MPI_COMM_WORLD); });
        n_missed += message == "(no error)";
        n_silent += message.find("damaged") == std::string::npos;
      }
    verdict("400 files with one byte changed are refused", n_missed, 0);
    verdict("... as damaged", n_silent, 0);

    std::string other    = good;
    other[version_place] = 'x';
    check_refused("another version",
                  scene,
                  with_checksum(other),
                  {"was written by version \"x",
                   "this is version \"" + program_info(1).version + "\""});
    other               = good;
    other[format_place] = 2;
    check_refused("another format",
                  scene,
                  with_checksum(other),
                  {"has format 2, allowed is format 1"});
    check_refused("no checkpoint",
                  scene,
                  std::string(1000, 'M'),
                  {"no checkpoint"});
    replace(good);
    check_message("no file",
                  message_of([] {
                    read_checkpoint_text(directory() + "/none", MPI_COMM_WORLD);
                  }),
                  {"Cannot read the checkpoint \"", "No such file"});
    verdict("the good one is read",
            message_of([] {
              read_checkpoint_text(directory(), MPI_COMM_WORLD);
            }) != "(no error)",
            0);
  }

  /// The tetrahedra of a file of version 2.2 in the opposite order.
  std::string
  renumbered(const std::string &name)
  {
    std::istringstream       in(gmsh_test::read_file(name));
    std::ostringstream       out;
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);)
      {
        std::istringstream words(line);
        std::string        number, type, rest;
        words >> number >> type;
        std::getline(words, rest);
        if (type == "4" && !rest.empty())
          lines.push_back(" " + type + rest);
        else
          {
            for (unsigned int i = 0; i < lines.size(); ++i)
              out << 1000 + i << lines[lines.size() - 1 - i] << '\n';
            lines.clear();
            out << line << '\n';
          }
      }
    return gmsh_test::write_file("checkpoint_renumbered.msh", out.str());
  }

  void
  test_other_scenes(const Given &given)
  {
    const auto check = [&](const std::string                  &what,
                           const std::function<void(Given &)> &change,
                           const std::vector<std::string>     &fragments) {
      Given other = given;
      change(other);
      const Scene scene(other, MPI_COMM_WORLD);
      check_message(what,
                    message_of([&] {
                      read_checkpoint(directory(),
                                      scene.bodies,
                                      scene.couplings,
                                      MPI_COMM_WORLD);
                    }),
                    fragments);
    };
    check("another degree",
          [](Given &other) { other.bodies[brick].degree = 2; },
          {"body \"brick\" has degree 1, now degree 2"});
    check("other degrees",
          [](Given &other) {
            other.bodies[outer].regions[1] = 1;
            other.bodies[outer].mixed      = false;
          },
          {"body \"outer\" has degrees 2 to 4, now degrees 1 to 4"});
    check("degrees exchanged between regions",
          [](Given &other) {
            other.bodies[bar].regions = {{0, 3}, {1, 2}};
          },
          {"body \"bar\" has its degrees in other cells than now"});
    check("degrees of other regions",
          [](Given &other) {
            other.bodies[inner].regions = {{0, 2}, {1, 3}, {2, 4}};
          },
          {"body \"inner\""});
    check("another form",
          [](Given &other) { other.bodies[inner].mixed = false; },
          {"body \"inner\" has pressures, now it has none"});
    check("another shape",
          [](Given &other) { other.bodies[bar].mesh.cells = "tetrahedra"; },
          {"body \"bar\" consists of hexahedra, now of tetrahedra"});
    check("another number of cells",
          [](Given &other) {
            other.bodies[bar].mesh.subdivisions = {3, 1, 1};
          },
          {"body \"bar\" has 2 cells, now 3"});
    check("another place of the refinement",
          [](Given &other) {
            other.bodies[inner].mesh.refine_near = "0, 1.5, 0, 0.4, 1";
          },
          {"body \"inner\""});
    check("vertices elsewhere in the same box",
          [](Given &other) { other.bodies[bar].mesh.distort = 0.2; },
          {"body \"bar\" has another geometry"});
    check("moved by 1e-8",
          [](Given &other) { other.bodies[block].mesh.translate[1] = 1e-8; },
          {"body \"block\" has another geometry"});
    check("the same mesh with cells in another order",
          [](Given &other) {
            other.bodies[block].mesh.file =
              renumbered(other.bodies[block].mesh.file);
          },
          {"body \"block\" has another geometry or other numbers of cells"});
    check(
      "a body missing",
      [](Given &other) { other.bodies.pop_back(); },
      {"the bodies inner, outer, block, solid, brick, bar, the scene has inner, outer, block, solid, brick"});
    check("another interface",
          [](Given &other) { other.interfaces[1].name = "weld"; },
          {"the interfaces glue, seam, the scene has glue, weld"});
    check("no interfaces",
          [](Given &other) { other.interfaces.clear(); },
          {"the interfaces glue, seam, the scene has (none)"});
    check(
      "sides exchanged",
      [](Given &other) {
        other.interfaces[1] = {"seam", brick, "zmin", block, "top"};
      },
      {"interface \"seam\" has its slave on body \"block\", now on body \"brick\""});
    check("another number of slave faces",
          [](Given &other) { other.interfaces[0].slave_boundary = "xmin"; },
          {"interface \"glue\" has ", " slave faces, now "});
    check("other slave faces",
          [](Given &other) { other.interfaces[1].slave_boundary = "bottom"; },
          {"interface \"seam\" has no values for some of the slave faces"});
    check("two things",
          [](Given &other) {
            other.bodies[brick].degree = 2;
            other.interfaces[1].name   = "weld";
          },
          {"degree 2", "weld"});
  }
} // namespace

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const Given                              given = given_scene();
  const Truth                              truth(given);
  test_ranks(given, truth);
  test_blocks(given, truth);
  const std::string good = gmsh_test::read_file(file());
  test_damage(Scene(given, MPI_COMM_WORLD), good);
  test_other_scenes(given);
  MPI_Barrier(MPI_COMM_WORLD);
  if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    std::filesystem::remove_all(directory());
}
