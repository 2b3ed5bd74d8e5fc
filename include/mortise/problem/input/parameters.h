// The parameters as plain data: one struct per subsection with the defaults.
// Meanings and units are in the entries, see --parameters.
//
// Files have the syntax of dealii::ParameterHandler. `parameter_file.h` reads
// the lines, `parameter_schema.h` declares and prints the parameters: a new one
// is a member here and an entry there.
#pragma once

#include <deal.II/base/point.h>

#include <mortise/base/error.h>
#include <mortise/body/mesh/mesh_source.h>
#include <mortise/material/factory.h>
#include <mortise/problem/input/interface_parameters.h>
#include <mortise/problem/input/parameter_file.h>
#include <mortise/problem/input/step_parameters.h>
#include <mortise/solvers/solver_options.h>
#include <mpi.h>

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace mortise
{
  /// The three components of a vector, each the text of an expression in x, y,
  /// z. Displacements of a boundary may also say "-" (free), and everything
  /// that an exact solution determines may say "exact".
  using Components = std::array<std::string, 3>;

  /// "ex; ey; ez", as VectorExpression takes it.
  inline std::string
  joined(const Components &components)
  {
    return components[0] + "; " + components[1] + "; " + components[2];
  }

  /// Loads and supports of one named boundary.
  struct BoundaryParameters
  {
    std::optional<std::string> pressure;
    /// Absent: where the body has finite strains.
    std::optional<bool>       pressure_follows;
    std::optional<Components> traction;
    std::optional<Components> force, moment; ///< totals
    std::optional<Components> displacement;
    std::array<double, 3>     displacement_axes{}; ///< rotation, degrees
    /// A vector along the axis, degrees, added to the displacement.
    std::optional<Components> rotation;
    /// Does it move as a rigid part? Displacement and rotation are then those
    /// of the reference point, "-" where they are free.
    std::string coupling = "distributing";
    /// Of force and rotation. Absent: the centroid.
    std::optional<std::array<double, 3>> reference_point;
    std::optional<std::string> normal_displacement; ///< excludes the others
    /// Of an elastic foundation.
    std::optional<std::string> normal_stiffness, tangential_stiffness;

    bool
    is_rigid() const
    {
      return coupling == "rigid";
    }
  };

  /// A prescribed displacement at a point, or along a straight line.
  struct PointSupport
  {
    std::string         text; ///< of both
    std::vector<double> ends; ///< coordinates of one or two points
    Components          displacement;
  };

  /// Unknowns of a body.
  enum class Formulation
  {
    automatic, ///< mixed from nu = 0.49 on
    displacement,
    mixed
  };

  struct BodyParameters
  {
    std::string                          name;
    unsigned int                         degree = 1;
    std::map<unsigned int, unsigned int> degree_by_region; ///< by material id
    std::vector<Ball>                    degree_near; ///< the last one holds
    unsigned int                         least_mapping_degree =
      1; ///< of curved meshes; no entry of a file
    Formulation        formulation = Formulation::automatic;
    MeshParameters     mesh;
    MaterialParameters material;
    /// Force per volume. Absent ("auto"): from the exact solution if that is
    /// given by expressions, else zero.
    std::optional<Components>  body_force;
    std::optional<std::string> temperature; ///< above that without strain
    std::vector<PointSupport>  supports;
    std::map<std::string, BoundaryParameters> boundaries;
  };

  enum class ExactKind
  {
    none,
    expressions,
    thick_sphere,
    thick_cylinder
  };

  struct ExactSolutionParameters
  {
    ExactKind                  kind = ExactKind::none;
    Components                 displacement; ///< for ExactKind::expressions
    std::optional<std::string> pressure;     ///< mean; the same, with nu = 0.5
  };

  struct SolverParameters
  {
    SolverMethod method           = SolverMethod::automatic;
    double       tolerance        = 1e-10;
    unsigned int max_iterations   = 1000;
    unsigned int max_gathered     = 30000; ///< "Multipliers on all ranks"
    bool         print_iterations = false;
    std::string  friction         = "newton"; ///< or "fixed point"
  };

  /// Adaptivity with a target error.
  struct AdaptivityParameters
  {
    std::optional<double> target_error; ///< relative; absent: none
    std::string           quantity;     ///< "NAME, x"; empty: energy norm
    std::string           strategy       = "hp";
    double                most_unknowns  = 2e6;
    unsigned int          largest_degree = max_degree;

    /// Are cells of hexahedra cut?
    bool
    splits() const
    {
      return target_error && strategy != "p";
    }
  };

  /// The displacement at a point of a body, reported in the summary.
  struct PointQuantity
  {
    std::string      name;
    unsigned int     body = 0; ///< index into Parameters::bodies
    dealii::Point<3> point;
  };

  /// Force and moment on a boundary of a body, reported in the summary.
  struct ResultantQuantity
  {
    std::string  name;
    unsigned int body = 0; ///< index into Parameters::bodies
    std::string  boundary;
  };

  struct OutputParameters
  {
    std::string              directory;
    std::vector<std::string> fields;               ///< of field_names()
    unsigned int             checkpoint_every = 0; ///< steps; 0: no checkpoints
    std::vector<PointQuantity>     points;
    std::vector<ResultantQuantity> resultants;
    std::array<double, 3>          moments_about{}; ///< a point
  };

  struct Parameters
  {
    std::string                      title;
    std::vector<BodyParameters>      bodies;
    std::vector<InterfaceParameters> interfaces;
    std::optional<Components>        gravity; ///< length per time squared
    /// xx, yy, zz, yz, zx, xy: of the cell that periodic interfaces repeat,
    /// "free" where the mean stress is given.
    std::array<std::string, 6> mean_strain{{"0", "0", "0", "0", "0", "0"}},
      mean_stress = mean_strain;
    ExactSolutionParameters exact_solution;
    SolverParameters        solver;
    AdaptivityParameters    adaptivity;
    StepParameters          steps;
    OutputParameters        output;

    std::string             file; ///< the parameter file, as it was given
    std::vector<Assignment> assignments; ///< its lines and those of --set
    /// "Body inner/Degree" -> "line 7 of FILE", "--set"
    std::map<std::string, std::string> origins;

    /// "Body inner/Degree (line 7 of scene.prm)"; without the parentheses for a
    /// default.
    std::string
    where(const std::string &path) const;

    /// Throw InputError with the value @p got at @p path and the allowed ones.
    [[noreturn]] void
    fail(const std::string &path,
         const std::string &got,
         const std::string &allowed) const;
  };

  /// Of Parameters::mean_strain.
  constexpr std::array<const char *, 6> components_of_strain = {
    {"xx", "yy", "zz", "yz", "zx", "xy"}};

  /// "body: boundary, boundary", for messages.
  inline std::string
  side_text(const Parameters &parameters, const SideParameters &side)
  {
    return parameters.bodies[side.body].name + ": " +
           join_names(side.boundaries);
  }

  /// Append the supports: interfaces that prescribe displacements along normals
  /// or rotated axes, one per component. Throws InputError.
  void
  add_supports(Parameters &parameters);

  /// Fields that Output/Fields may name.
  const std::vector<std::string> &
  field_names();

  /// A --set option: "Body inner/Mesh/Subdivisions=8, 4".
  using Settings = std::vector<std::string>;

  /// Parse the text of a parameter file, with @p settings after it. @p file stands in messages
  /// and locates included files. Throws InputError, also for a value out of its
  /// range. Not collective; reads only included files.
  Parameters
  parse_parameters(const std::string &text,
                   const std::string &file,
                   const Settings    &settings = {});

  /// The parameters of @p assignments, of which later ones count. Throws
  /// InputError.
  Parameters
  parse_parameters(const std::vector<Assignment> &assignments,
                   const std::string             &file);

  /// Read and parse @p file. Collective: rank 0 reads, every rank gets the same parameters or
  /// the same InputError.
  Parameters
  read_parameters(const std::string &file,
                  const Settings    &settings,
                  MPI_Comm           comm);

  /// Check combinations and expressions without meshes or files. Throws
  /// InputError.
  void
  validate(const Parameters &parameters);

  /// Check that the output directory can be made and written, without creating
  /// it. Throws InputError on all ranks. Collective.
  void
  check_output_directory(const Parameters &parameters, MPI_Comm comm);

  /// Of each body, where they are known.
  using NamesOfBoundaries =
    std::vector<std::optional<std::vector<std::string>>>;

  /// Do the boundaries that the scene names exist? @p names[b] are those of the mesh of body b.
  /// Checks the Boundary subsections, both sides of the interfaces, and the
  /// resultants. Throws InputError with all that do not, and the names that
  /// exist.
  void
  check_boundary_names(const Parameters        &parameters,
                       const NamesOfBoundaries &names);
} // namespace mortise
