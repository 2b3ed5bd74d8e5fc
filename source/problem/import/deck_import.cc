#include <deal.II/base/mpi.h>

#include <mortise/base/error.h>
#include <mortise/base/quotes.h>
#include <mortise/output/whole_file.h>
#include <mortise/problem/import/deck_import.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>

#include "import_bodies.h"
#include "import_conditions.h"
#include "import_history.h"
#include "import_interfaces.h"
#include "import_material.h"
#include "import_remarks.h"

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Files by their names.
    using ImportFiles = std::vector<std::pair<std::string, std::string>>;

    /// Keywords that the importer reads, or that mean nothing to a scene.
    const std::set<std::string> known_keywords = {
      // read
      "*AMPLITUDE",
      "*BOUNDARY",
      "*CLEARANCE",
      "*CLOAD",
      "*CONTACT PAIR",
      "*COUPLING",
      "*DENSITY",
      "*DISTRIBUTING",
      "*DLOAD",
      "*DSLOAD",
      "*ELASTIC",
      "*ELEMENT",
      "*EXPANSION",
      "*FOUNDATION",
      "*FRICTION",
      "*HYPERELASTIC",
      "*INITIAL CONDITIONS",
      "*KINEMATIC",
      "*KINEMATIC COUPLING",
      "*MATERIAL",
      "*NODE PRINT",
      "*ORIENTATION",
      "*PLASTIC",
      "*RIGID BODY",
      "*SOLID SECTION",
      "*STATIC",
      "*STEP",
      "*END STEP",
      "*SURFACE BEHAVIOR",
      "*SURFACE INTERACTION",
      "*TEMPERATURE",
      "*TIE",
      "*TRANSFORM",
      // passed over
      "*HEADING",
      "*PREPRINT",
      "*RESTART",
      "*OUTPUT",
      "*NODE FILE",
      "*NODE OUTPUT",
      "*ELEMENT OUTPUT",
      "*EL FILE",
      "*EL PRINT",
      "*ENERGY PRINT",
      "*CONTACT FILE",
      "*CONTACT OUTPUT",
      "*CONTACT PRINT",
      "*SECTION PRINT",
      "*MONITOR",
      "*PRINT",
      "*CONTROLS",
      "*SOLVER CONTROLS",
      "*CONTACT CONTROLS",
      "*PHYSICAL CONSTANTS",
      "*CONDUCTIVITY",
      "*SPECIFIC HEAT",
      "*DAMPING",
      "*FILE FORMAT",
      "*FILTER",
      "*DIAGNOSTICS",
      "*ENERGY OUTPUT",
      "*ELEMENT PRINT",
      "*TIME POINTS",
      "*END"};

    /// Told by those who read sections and materials.
    bool
    is_told_elsewhere(const std::string &keyword)
    {
      return keyword == "*CREEP" || keyword == "*HYPERFOAM" ||
             keyword == "*USER MATERIAL" || keyword == "*DEPVAR" ||
             (keyword.size() > 8 &&
              keyword.compare(keyword.size() - 8, 8, " SECTION") == 0);
    }

    /// What a step may be in place of *STATIC.
    const std::set<std::string> other_procedures = {
      "*BUCKLE",
      "*COMPLEX FREQUENCY",
      "*COUPLED TEMPERATURE-DISPLACEMENT",
      "*DYNAMIC",
      "*FREQUENCY",
      "*HEAT TRANSFER",
      "*MODAL DYNAMIC",
      "*STEADY STATE DYNAMICS",
      "*UNCOUPLED TEMPERATURE-DISPLACEMENT",
      "*VISCO"};

    /// Read outside of steps only.
    const std::set<std::string> of_model = {"*CONTACT PAIR",
                                            "*COUPLING",
                                            "*ELASTIC",
                                            "*EXPANSION",
                                            "*FRICTION",
                                            "*MATERIAL",
                                            "*PLASTIC",
                                            "*SURFACE BEHAVIOR",
                                            "*SURFACE INTERACTION",
                                            "*TIE"};

    void
    tell_unknown_keywords(const InpDeck     &deck,
                          const ImportSteps &steps,
                          ImportRemarks     &remarks)
    {
      for (const ImportStep &step : steps.steps)
        for (const InpBlock *block : step.blocks)
          if (of_model.count(block->keyword) > 0)
            remarks.left_out(block->place, block->keyword + " within a step");
      for (const InpBlock &block : deck.blocks)
        if (other_procedures.count(block.keyword) > 0)
          remarks.approximated(block.place,
                               block.keyword + ": the step is static");
        else if (known_keywords.count(block.keyword) == 0 &&
                 !is_told_elsewhere(block.keyword))
          remarks.left_out(block.place, block.keyword);
    }

    /// The mesh of a body with its boundaries as surfaces.
    std::string
    mesh_text(const ImportBodies &bodies,
              const unsigned int  body,
              const std::string  &deck_name)
    {
      const InpDeck     &deck = bodies.deck;
      std::ostringstream text;
      text.precision(17);
      text << "** body " << bodies.bodies[body].name << " of " << deck_name
           << "\n*NODE\n";
      std::vector<unsigned int> number(deck.nodes.size(), 0);
      unsigned int              n = 0;
      for (const unsigned int node : bodies.bodies[body].nodes)
        {
          number[node]      = ++n;
          const Point<3> &x = deck.nodes[node];
          text << n << ", " << x[0] << ", " << x[1] << ", " << x[2] << "\n";
        }
      std::map<unsigned int, unsigned int> element_number;
      std::string                          type;
      for (const unsigned int e : bodies.bodies[body].elements)
        {
          const InpElement &element = deck.elements[e];
          element_number.emplace(e, element_number.size() + 1);
          const std::string its = "C3D" + std::to_string(element.nodes.size());
          if (its != type)
            text << "*ELEMENT, TYPE=" << its << ", ELSET=body\n";
          type = its;
          text << element_number.size();
          unsigned int in_line = 0;
          for (const unsigned int node : element.nodes)
            text << (++in_line % 12 == 0 ? ",\n" : ", ") << number[node];
          text << "\n";
        }
      std::map<std::string, std::string> surfaces;
      for (const ImportFace &face : bodies.faces)
        if (face.body == body && !face.boundary.empty())
          surfaces[face.boundary] +=
            std::to_string(element_number.at(face.side.element)) + ", S" +
            std::to_string(face.side.face + 1) + "\n";
      for (const auto &[name, sides] : surfaces)
        text << "*SURFACE, NAME=" << name << "\n" << sides;
      return text.str();
    }

    /// "2    # C3D8R": linear elements that lock, or that are used in bending
    /// because they do not, are of degree 2.
    std::string
    degree_text(const InpDeck        &deck,
                const ImportBody     &body,
                const ImportMaterial &material)
    {
      std::set<std::string> types;
      bool                  linear = true;
      for (const unsigned int e : body.elements)
        {
          types.insert(deck.elements[e].type);
          linear = linear &&
                   deck.elements[e].nodes.size() == deck.elements[e].n_vertices;
        }
      const bool plain =
        std::all_of(types.begin(), types.end(), [](const std::string &type) {
          return type == "C3D8" || type == "C3D4";
        });
      return std::string(linear && plain && !material.needs_more ? "1" : "2") +
             "  # " +
             join_names(std::vector<std::string>(types.begin(), types.end()));
    }

    /// Entries of Output/Points: the nodes of small sets that are printed.
    std::string
    points_text(const ImportBodies &bodies)
    {
      const InpDeck                     &deck = bodies.deck;
      std::map<std::string, std::string> entries; // places by name
      for (const InpBlock &block : deck.blocks)
        if (block.keyword == "*NODE PRINT" || block.keyword == "*NODE FILE" ||
            block.keyword == "*NODE OUTPUT")
          {
            const bool displacements = std::any_of(
              block.lines.begin(), block.lines.end(), [](const InpLine &line) {
                return std::count(line.words.begin(), line.words.end(), "U") >
                       0;
              });
            const auto nodes =
              deck.find_nodes(block.option("NSET"), block.instance);
            if (nodes.size() > 10 || !displacements)
              continue;
            for (const unsigned int node : nodes)
              if (!bodies.bodies_of_node[node].empty())
                {
                  const Point<3>    &x = deck.nodes[node];
                  const std::string &body =
                    bodies.bodies[bodies.bodies_of_node[node][0]].name;
                  const std::string at = body + ": " + number_text(x[0]) +
                                         ", " + number_text(x[1]) + ", " +
                                         number_text(x[2]);
                  std::string name =
                    "node_" + std::to_string(deck.node_tags[node]);
                  if (const auto same = entries.find(name);
                      same != entries.end() && same->second != at)
                    name += "_" + body; // of another instance
                  entries.emplace(name, at);
                }
          }
      std::string text;
      for (const auto &[name, at] : entries)
        text += (text.empty() ? "" : "; ") + name + ": " + at;
      return text;
    }

    ImportFiles
    import_files(const InpDeck            &deck,
                 const std::string        &deck_name,
                 const std::string        &stem,
                 std::vector<std::string> &told)
    {
      ImportRemarks               remarks;
      ImportSteps                 steps(deck, remarks);
      const ImportMaterials       materials(deck, steps, remarks);
      ImportBodies                bodies(deck, remarks);
      std::vector<ImportMaterial> of_body;
      for (const ImportBody &body : bodies.bodies)
        {
          of_body.push_back(materials.of(*body.section, remarks));
          steps.nonlinear = steps.nonlinear || of_body.back().nonlinear;
        }
      ImportConditions       conditions(bodies, steps, remarks);
      const ImportInterfaces interfaces(bodies, conditions, steps, remarks);
      conditions.name_boundaries();
      tell_unknown_keywords(deck, steps, remarks);

      ImportFiles files;
      std::string names, sections;
      for (unsigned int b = 0; b < bodies.bodies.size(); ++b)
        {
          const ImportBody &body = bodies.bodies[b];
          const std::string mesh = stem + "_" + body.name + ".inp";
          files.emplace_back(mesh, mesh_text(bodies, b, deck_name));
          names += (names.empty() ? "" : ", ") + body.name;
          const std::string temperature =
            of_body[b].expansion == 0. ? "" : conditions.temperature_text(b);
          if (!temperature.empty())
            of_body[b].text += "    set Thermal expansion = " +
                               number_text(of_body[b].expansion) + "\n";
          sections +=
            "\nsubsection Body " + body.name +
            "\n  set Degree = " + degree_text(deck, body, of_body[b]) + "\n" +
            conditions.body_text(b, of_body[b]) + temperature +
            conditions.supports_text(b) +
            "  subsection Mesh\n    set Source = file\n    set File   "
            "= " +
            mesh + "\n  end\n  subsection Material\n" + of_body[b].text +
            "  end\n" + conditions.boundaries_text(b) + "end\n";
        }
      told             = remarks.lines();
      std::string text = "# Made by mortise --import " + deck_name + "\n";
      for (const std::string &line : told)
        text += "# " + line + "\n";
      text += "\nset Bodies     = " + names + "\n";
      if (interfaces.any())
        text += "set Interfaces = " + interfaces.names() + "\n";
      text += sections + interfaces.text() + steps.text() +
              "\nsubsection Output\n  set Fields     = displacement, stress" +
              (interfaces.any() ? ", traction" : "") + "\n";
      if (const std::string points = points_text(bodies); !points.empty())
        text += "  set Points     = " + points + "\n";
      if (const std::string held = conditions.resultants_text(); !held.empty())
        text += "  set Resultants = " + held + "\n";
      files.emplace_back(stem + ".prm", text + "end\n");
      return files;
    }
  } // namespace

  std::string
  import_deck(const std::string &file,
              const Settings    &settings,
              const MPI_Comm     comm)
  {
    std::filesystem::path directory = ".";
    const std::string     output    = "Output/Directory=";
    for (const std::string &setting : settings)
      if (setting.compare(0, output.size(), output) == 0)
        directory = setting.substr(output.size());
      else
        throw InputError("--import with --set " + in_quotes(setting) +
                         "; allowed: --output; settings are for the scene");
    std::string              problem;
    ImportFiles              files;
    std::vector<std::string> told;
    const unsigned int       rank = Utilities::MPI::this_mpi_process(comm);
    if (rank == 0)
      try
        {
          const InpDeck deck =
            read_inp_deck(file, [&](const std::string &what) {
              throw InputError("--import: the deck " +
                               file_in_quotes(file, '\'') + " " + what);
            });
          files = import_files(deck,
                               std::filesystem::path(file).filename().string(),
                               std::filesystem::path(file).stem().string(),
                               told);
          std::error_code none;
          for (const auto &entry : files)
            if (const auto name = directory / entry.first;
                std::filesystem::exists(name, none))
              throw InputError("--import would write " +
                               file_in_quotes(name.string()) +
                               ", which is there already; allowed: another "
                               "directory by --output");
        }
      catch (const InputError &error)
        {
          problem = error.what();
        }
    throw_if_any(problem, comm);
    std::string text;
    const auto  n_files = Utilities::MPI::broadcast(comm, files.size());
    files.resize(n_files);
    for (auto &[name, content] : files)
      {
        name = Utilities::MPI::broadcast(comm, name);
        write_whole_file((directory / name).string(), content, comm);
        text += (directory / name).string() + "\n";
      }
    for (const std::string &line : told)
      text += line + "\n";
    return text;
  }
} // namespace mortise
