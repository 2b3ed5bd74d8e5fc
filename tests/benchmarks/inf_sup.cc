// Inf-sup constants of one case, as one line of JSON. Not a test: inf_sup.py
// makes the tables of doc/measurements/inf_sup.md of them.
//
//   inf_sup pressure [KEY=VALUE]...
//     degree, source, cells, extent, subdivisions, distort, refine (see "Refine
//     near"), regions ("id:degree,..."), clamped (names, or all), equal=1 for
//     pressures of the displacement's degree; state and size of a deformation,
//     see inf_sup_stretched.h, with clamped=all
//   inf_sup multiplier [KEY=VALUE]...
//     the same for the slave, those of the master with master_ before them,
//     extent, master_extent; reduced=0 for multipliers that ignore clamped
//     rims; halvings, raise: of the space that the norm is computed in
#include <cstdio>
#include <iostream>
#include <map>
#include <sstream>

#include "../solvers/inf_sup_multiplier.h"
#include "../solvers/inf_sup_stretched.h"

using namespace mortise;
using namespace mortise::testing;

namespace
{
  class Options
  {
  public:
    Options(const int argc, char **argv)
    {
      for (int i = 2; i < argc; ++i)
        {
          const std::string text  = argv[i];
          const auto        equal = text.find('=');
          if (equal == std::string::npos)
            throw std::runtime_error(text + ": got no '='");
          values[text.substr(0, equal)] = text.substr(equal + 1);
        }
    }

    std::string
    text(const std::string &key, const std::string &otherwise) const
    {
      const auto found = values.find(key);
      return found == values.end() ? otherwise : found->second;
    }

    template <typename T>
    std::vector<T>
    list(const std::string &key, const std::string &otherwise) const
    {
      std::vector<T>     result;
      std::istringstream entries(text(key, otherwise));
      for (std::string entry; std::getline(entries, entry, ',');)
        {
          std::istringstream stream(entry);
          T                  value;
          stream >> value;
          result.push_back(value);
        }
      return result;
    }

    template <typename T>
    T
    value(const std::string &key, const T otherwise) const
    {
      const auto all = list<T>(key, "");
      return all.empty() ? otherwise : all[0];
    }

  private:
    std::map<std::string, std::string> values;
  };

  const std::string sides = "xmin,xmax,ymin,ymax";

  InfSupBody
  read_body(const Options     &options,
            const std::string &prefix,
            const std::string &extent)
  {
    InfSupBody body;
    body.degree           = options.value(prefix + "degree", 2u);
    body.mesh.source      = options.text(prefix + "source", "box");
    body.mesh.cells       = options.text(prefix + "cells", "hexahedra");
    body.mesh.extent      = options.list<double>(prefix + "extent", extent);
    body.mesh.distort     = options.value(prefix + "distort", 0.);
    body.mesh.refine_near = options.text(prefix + "refine", "");
    body.mesh.subdivisions =
      options.list<unsigned int>(prefix + "subdivisions", "2,2,2");
    for (const auto &region : options.list<std::string>(prefix + "regions", ""))
      {
        const auto colon = region.find(':');
        body.degree_by_region[std::stoul(region)] =
          std::stoul(region.substr(colon + 1));
      }
    std::string clamped = options.text(prefix + "clamped", "");
    if (clamped == "all")
      clamped = sides + ",zmin,zmax";
    if (clamped == "sides")
      clamped = sides;
    std::istringstream names(clamped);
    for (std::string name; std::getline(names, name, ',');)
      body.clamped.push_back(name);
    return body;
  }

  void
  pressure(const Options &options)
  {
    const InfSupBody  body  = read_body(options, "", "0,0,0,1,1,1");
    const std::string state = options.text("state", "");
    const auto        result =
      state.empty() ?
               pressure_inf_sup(body,
                         options.text("clamped", "") == "all",
                         options.value("equal", 0) == 1) :
               stretched_inf_sup(body, deformation(state, options.value("size", 1.)));
    std::printf("{\"displacements\": %u, \"pressures\": %u, \"kernel\": %u, "
                "\"beta\": %.6g, \"largest\": %.6g}\n",
                result.displacements,
                result.pressures,
                result.kernel,
                result.beta,
                result.largest);
  }

  void
  multiplier(const Options &options)
  {
    NormSpace space;
    space.halvings = options.value("halvings", space.halvings);
    space.degrees  = options.value("raise", space.degrees);
    const auto result =
      multiplier_inf_sup(read_body(options, "", "0,0,0,1,1,0.5"),
                         read_body(options, "master_", "0,0,0.5,1,1,1"),
                         options.value("reduced", 1) == 1,
                         space,
                         options.value("dual", 0) == 1 ?
                           MultiplierBasis::dual :
                           MultiplierBasis::standard);
    std::printf("{\"multipliers\": %u, \"beta\": %.6g, \"slave\": %.6g}\n",
                result.multipliers,
                result.beta,
                result.slave);
  }
} // namespace

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const std::string                        what = argc > 1 ? argv[1] : "";
  if (what == "pressure")
    pressure(Options(argc, argv));
  else if (what == "multiplier")
    multiplier(Options(argc, argv));
  else
    {
      std::cerr << "inf_sup pressure | multiplier [KEY=VALUE]...\n";
      return 2;
    }
  return 0;
}
