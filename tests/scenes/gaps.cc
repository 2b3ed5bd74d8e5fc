// Proves that gaps and penetrations up to Search distance are bridged with the
// fields exact that a tie across a gap can pass, and that surfaces farther
// apart are an error.
//
// The tie is u_s(x) = u_m(x + g n), g the gap along the slave's normal n.
// Constants always pass. A linear displacement u = a + G x does if G n = 0:
// across a flat gap all fields of the tangential coordinates, with whatever
// constant traction; between cylinders, the stretch along the axis, without a
// traction (Poisson ratio 0), since a varying one acts on two areas. A rotation
// w of the master about an axis in the plane of a flat gap moves the slave by w
// x (x + g n): it turns as much and is shifted by g w x n. The second body
// hangs on the interface alone.
#include <mortise/base/error.h>
#include <mortise/base/run_log.h>

#include "scene.h"
#include "scenes.h"

using namespace mortise;
using namespace mortise::testing;

namespace
{
  Settings
  degree(const std::string &first,
         const std::string &second,
         const unsigned int p)
  {
    return {"Body " + first + "/Degree=" + std::to_string(p),
            "Body " + second + "/Degree=" + std::to_string(p),
            "Solver/Tolerance=1e-13"};
  }

  void
  check_constants(const std::string &what, const StepSummary &step)
  {
    const InterfaceSummary &interface = step.interfaces[0];
    verdict(what + ": partition of unity 1e-12",
            *interface.partition_of_unity_error,
            1e-12);
    verdict(what + ": force 1e-12", *interface.force_residual, 1e-12);
  }

  /// Two unit squares, 3 x 3 and 4 x 4 faces; the upper one is moved up by @p gap.
  Settings
  flat_gap(const double gap)
  {
    return {"Body lower/Mesh/Subdivisions=3, 3, 1",
            "Body upper/Mesh/Subdivisions=4, 4, 1",
            "Body upper/Mesh/Translate=0, 0, " + number(gap)};
  }

  const double largest_flat_gap =
    0.5 * std::sqrt(2.) / 3.; ///< half of the larger diagonal
  const Settings flat_swapped = {"Interface glue/Slave=upper: zmin",
                                 "Interface glue/Master=lower: zmax"};

  std::string
  flat(const std::string &tractions_of_upper)
  {
    return tied("lower, upper", "lower: zmax", "upper: zmin") +
           box("lower", "0, 0, 0, 1, 1, 0.5", "zmin xmin", "xmax ymin ymax") +
           box("upper", "0, 0, 0.5, 1, 1, 1", "", tractions_of_upper);
  }

  void
  check_flat(const std::string &what,
             const double       gap,
             const unsigned int p,
             const Settings    &settings)
  {
    const std::string tangential =
      "Exact solution/Displacement=0.3 + 0.1*x + 0.03*y; "
      "0.2 + 0.05*y - 0.02*x; -0.1 + 0.02*x + 0.06*y";
    const StepSummary step =
      run_scene(flat("xmin xmax ymin ymax zmax"),
                flat_gap(gap) + degree("lower", "upper", p) +
                  Settings{tangential} + settings)
        .steps.back();
    exact_verdicts(what, *step.errors);
    check_constants(what, step);
    verdict(what + ": coverage 1e-12",
            *step.interfaces[0].worst_face_coverage_error,
            1e-12);
  }

  /// The lower body turns about x by w: u = w (0, -z, y).
  void
  check_rotation(const std::string &what,
                 const double       gap,
                 const bool         upper_is_slave)
  {
    const double      w      = 0.1;
    const Settings    motion = {"Exact solution/Displacement=0; -0.1*z; 0.1*y",
                                "Output/Points=a: upper: 0, 0, " +
                                  number(1. + gap) + "; b: upper: 1, 1, " +
                                  number(1. + gap) + "; c: upper: 0.5, 0.5, " +
                                  number(0.75 + gap)};
    const StepSummary step =
      run_scene(flat("zmax"),
                flat_gap(gap) + degree("lower", "upper", 2) + motion +
                  (upper_is_slave ? flat_swapped : Settings()))
        .steps.back();
    // the lower point at z = 0.5 and the upper one at 0.5 + gap move alike
    const double at[3][2] = {{0., 1.}, {1., 1.}, {0.5, 0.75}}; // y, z - gap
    double       error    = 0.;
    for (unsigned int i = 0; i < 3; ++i)
      {
        const std::vector<double> &u = step.quantities[i].second;
        error                        = std::max({error,
                                                 std::fabs(u[0]),
                                                 std::fabs(u[1] + w * at[i][1]),
                                                 std::fabs(u[2] - w * at[i][0])});
      }
    verdict(what + ": shifted by w x g n 1e-11", error, 1e-11);
  }

  /// Two layers about radius 1.5, the outer one farther out by @p gap: faces of 1.5 pi / 8 at least.
  std::string
  curved(const bool sphere, const double gap)
  {
    const std::string source = sphere ? "shell octant" : "cylinder sector",
                      end    = sphere ? "" : ", 0.5";
    return tied("inner, outer", "inner: outside", "outer: inside") +
           body("inner",
                source,
                "1, 1.5" + end,
                "inside",
                sphere ? "" : "zmin zmax") +
           body("outer",
                source,
                number(1.5 + gap) + ", 2" + end,
                "",
                sphere ? "" : "zmin zmax");
  }

  Settings
  curved_meshes(const bool sphere, const bool outer_is_slave)
  {
    return (sphere ? Settings{"Body inner/Mesh/Subdivisions=2, 1",
                              "Body outer/Mesh/Subdivisions=3, 1"} :
                     Settings{"Body inner/Mesh/Subdivisions=4, 1, 2",
                              "Body outer/Mesh/Subdivisions=6, 1, 1",
                              "Body inner/Material/Poisson ratio=0",
                              "Body outer/Material/Poisson ratio=0"}) +
           (outer_is_slave ? Settings{"Interface glue/Slave=outer: inside",
                                      "Interface glue/Master=inner: outside"} :
                             Settings());
  }

  void
  check_curved(const bool         sphere,
               const double       gap,
               const unsigned int p,
               const bool         outer_is_slave)
  {
    const std::string what =
      std::string(sphere ? "sphere" : "cylinder") + ", gap " +
      RunLog::number(gap) +
      (outer_is_slave ? ", outer slave" : ", inner slave") + ", degree " +
      std::to_string(p);
    const Settings settings =
      curved_meshes(sphere, outer_is_slave) + degree("inner", "outer", p);
    const StepSummary moved =
      run_scene(curved(sphere, gap),
                settings +
                  Settings{"Exact solution/Displacement=0.3; -0.2; 0.1"})
        .steps.back();
    check_constants(what + ", translation", moved);
    verdict(what + ", translation: displacement 1e-10",
            *moved.errors->displacement_l2,
            1e-10);
    if (sphere)
      return;
    const StepSummary stretched =
      run_scene(curved(sphere, gap),
                settings +
                  Settings{"Exact solution/Displacement=0.3; -0.2; 0.1*z"})
        .steps.back();
    exact_verdicts(what + ", stretch", *stretched.errors);
  }

} // namespace

int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const Settings at_rest = {"Exact solution/Displacement=0; 0; 0"};
  for (const double sign : {1., -1.})
    {
      const std::string side   = sign > 0. ? "gap" : "penetration";
      const double      within = 0.99 * sign * largest_flat_gap,
                   beyond      = 1.01 * sign * largest_flat_gap;
      for (const unsigned int p : {1, 2, 3})
        check_flat("flat " + side + ", degree " + std::to_string(p),
                   within,
                   p,
                   {});
      check_flat("flat " + side + ", swapped", within, 2, flat_swapped);
      check_flat("flat " + side + ", distorted faces",
                 within / 2.,
                 2,
                 {"Solver/Method=condensed",
                  "Body lower/Mesh/Distort=0.2",
                  "Body upper/Mesh/Distort=0.2"});
      check_rotation("rotation, " + side, within, false);
      check_rotation("rotation, " + side + ", swapped", within, true);
      check_message("flat " + side + ": do not meet",
                    flat(""),
                    flat_gap(beyond) + at_rest,
                    "do not meet");
      check_flat("flat " + side + ", longer Search distance",
                 beyond,
                 1,
                 {"Interface glue/Search distance=0.51"});

      for (const bool sphere : {false, true})
        for (const bool outer_is_slave : {false, true})
          for (const unsigned int p : {1, 2, 3})
            check_curved(sphere, 0.25 * sign, p, outer_is_slave);
    }
  check_message("cylinder, gap: do not meet",
                curved(false, 0.45),
                curved_meshes(false, false) + at_rest,
                "do not meet");
}
