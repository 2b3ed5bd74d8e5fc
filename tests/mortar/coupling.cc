// Proves that D and M integrate over the same points and completely: B u is
// zero where slave and master have the same constant, linear or polynomial
// displacement, on flat surfaces of any mesh, hanging nodes, mixed degrees and
// clamped rims included; on curved ones constants pass exactly, and what
// becomes of linear fields is the gap between the two discrete surfaces, which
// falls as the geometry's error does. lambda^T B u is the work of lambda on
// both surfaces; force and moment balance; B at nodes is B in hierarchical
// functions. The same on every number of ranks.
#include <mortise/operators/bulk_system.h>
#include <scenes/scene.h>

#include "assembled.h"

namespace mortise::testing
{
  using namespace dealii;
  using Index = types::global_dof_index;

  /// The multiplier @p q, where nothing is prescribed.
  mortise::Vector
  multiplier(const TiedScene &scene, const Field &q)
  {
    mortise::Vector result = scene.multiplier();
    set_multiplier(scene.coupling(),
                   values_at_nodes(scene.coupling().interface->slave(), q),
                   result);
    return result;
  }

  /// The work of a polynomial traction of degree @p p on displacements that
  /// are not the same on both sides.
  void
  check_work(const std::string &what, const Assembled &tied, const unsigned p)
  {
    const TiedScene        &scene     = tied.scene;
    const InterfaceHandler &interface = *scene.coupling().interface;
    const mortise::Vector u = random(scene.field.numbering.owned(), scene.comm);
    for (const unsigned int degree : {0u, 1u, p})
      {
        const Field  q = polynomial(degree);
        const double expected =
          surface_integral(scene, interface.slave(), u, q) -
          surface_integral(scene, interface.master(), u, q);
        const mortise::Vector lambda = multiplier(scene, q);
        const mortise::Vector jump   = tied.constraint(u);
        verdict(what + ": work of a traction of degree " +
                  std::to_string(degree) + " 1e-13",
                std::fabs(lambda * jump - expected) /
                  (lambda.l2_norm() * jump.l2_norm()),
                1e-13);
      }
  }

  /// On flat surfaces that cover each other; @p p: of polynomials that both
  /// sides hold.
  void
  check_flat(const std::string &what,
             const TiedBody    &slave,
             const TiedBody    &master,
             const unsigned int p)
  {
    const Assembled tied(slave, master);
    const auto     &coupling = tied.scene.coupling();
    for (const unsigned int degree : {0u, 1u, p})
      verdict(what + ": B u of degree " + std::to_string(degree) + " 1e-12",
              tied.residual(polynomial(degree)),
              1e-12);
    const auto errors =
      transfer_errors(coupling, tied.scene.owned_multiplier, tied.scene.comm);
    verdict(what + ": partition of unity 1e-13",
            errors.partition_of_unity,
            1e-13);
    verdict(what + ": linear completeness 1e-13",
            errors.linear_completeness,
            1e-13);
    const auto balance =
      resultants(coupling,
                 random(tied.scene.owned_multiplier, tied.scene.comm),
                 tied.scene.comm);
    verdict(what + ": force 1e-13", balance.force_residual, 1e-13);
    verdict(what + ": moment 1e-13", balance.moment_residual, 1e-13);
    check_work(what, tied, slave.degree);

    const Assembled alone(slave, master, MPI_COMM_SELF);
    const Field     a = polynomial(p), b = polynomial(p, 0.3);
    const auto      relative = [](const double got, const double expected) {
      return std::fabs(got / expected - 1.);
    };
    verdict(what + ": as many multipliers as on one rank",
            relative(tied.B.m(), alone.B.m()),
            0);
    verdict(what + ": B as on one rank 1e-13",
            relative(tied.norm(), alone.norm()),
            1e-13);
    verdict(what + ": B u as on one rank 1e-12",
            relative(tied.constraint(tied.interpolate(a, b)).l2_norm(),
                     alone.constraint(alone.interpolate(a, b)).l2_norm()),
            1e-12);
  }

  void
  check_flat_meshes()
  {
    const std::string kinds[] = {"hexahedra", "tetrahedra"};
    struct Pair
    {
      bool         slave_tets, master_tets;
      unsigned int p, q;
    };
    for (const auto &[slave_tets, master_tets, p, q] :
         {Pair{false, false, 1, 1},
          {false, false, 5, 4},
          {false, true, 2, 3},
          {true, false, 2, 2},
          {true, true, 1, 1},
          {true, true, 4, 5}})
      {
        TiedBody slave = lower(p, slave_tets), master = upper(q, master_tets);
        if (p == 2)
          {
            turn(slave);
            turn(master);
          }
        check_flat(kinds[slave_tets] + " " + std::to_string(p) + ", " +
                     kinds[master_tets] + " " + std::to_string(q),
                   slave,
                   master,
                   std::min(p, q));
      }
    TiedBody matching          = upper(3);
    matching.mesh.subdivisions = {3, 2, 1};
    check_flat("matching faces", lower(3), matching, 3);
    TiedBody hanging = lower(3), hanging_master = upper(2);
    hanging.mesh.refine_near        = "0, 0, 1, 0.1, 2; 1, 1, 1, 0.1, 1";
    hanging_master.mesh.refine_near = "1, 0, 1, 0.1, 1";
    check_flat("hanging nodes", hanging, hanging_master, 2);
    TiedBody mixed          = lower(2);
    mixed.mesh.subdivisions = {4, 2, 2};
    mixed.degree_by_region  = {{4, 3}, {5, 2}, {6, 4}, {7, 3}};
    check_flat("mixed degrees", mixed, upper(2), 2);
  }

  /// Bilinear faces: linear fields, but no others.
  void
  check_distorted()
  {
    for (const unsigned int p : {1, 2})
      {
        TiedBody slave = lower(p), master = upper(p);
        slave.mesh.distort  = 0.2;
        master.mesh.distort = 0.25;
        const Assembled   tied(slave, master);
        const std::string what = "distorted, p = " + std::to_string(p);
        for (const unsigned int degree : {0, 1})
          verdict(what + ": B u of degree " + std::to_string(degree) + " 1e-12",
                  tied.residual(polynomial(degree)),
                  1e-12);
      }
  }

  /// Both sides are held at x = 0.
  void
  check_rims()
  {
    for (const bool tetrahedra : {false, true})
      for (const unsigned int p : {1, 2, 4})
        {
          TiedBody slave = lower(p, tetrahedra), master = upper(p);
          slave.dirichlet = master.dirichlet = {{"xmin", {{true, true, true}}}};
          const Assembled   tied(slave, master);
          const std::string what =
            std::string(tetrahedra ? "tetrahedra" : "hexahedra") +
            " beside a rim, p = " + std::to_string(p);
          const Field rest = polynomial(p - 1);
          verdict(what + ": B u of what vanishes there 1e-12",
                  tied.residual(
                    [&](const Point<dim> &x) { return x[0] * rest(x); }),
                  1e-12);
          const auto errors = transfer_errors(tied.scene.coupling(),
                                              tied.scene.owned_multiplier,
                                              tied.scene.comm);
          verdict(what + ": partition of unity 1e-13",
                  errors.partition_of_unity,
                  1e-13);
          verdict(what + ": linear completeness 1e-13",
                  errors.linear_completeness,
                  1e-13);
        }
  }

  /// All of the master is covered, and constants are exact.
  void
  check_partial()
  {
    TiedBody master    = upper(2);
    master.mesh.extent = {0., 0., 1., 0.6, 0.5, 2.};
    const Assembled tied(lower(2), master);
    double          area = 0.;
    for (const LocalCoupling &local : tied.scene.coupling().local)
      if (!local.partners.empty())
        for (unsigned int v = 0; v < 4; ++v)
          for (unsigned int w = 0; w < 4; ++w)
            area += local.mass(
              trace_basis(FaceShape::quadrilateral, 2).vertex_function(v),
              trace_basis(FaceShape::quadrilateral, 2).vertex_function(w));
    area = Utilities::MPI::sum(area, tied.scene.comm);
    verdict("partial cover: area 1e-12", std::fabs(area / 0.3 - 1.), 1e-12);
    verdict("partial cover: B u of degree 1 1e-12",
            tied.residual(polynomial(1)),
            1e-12);
  }

  /// B in values at nodes, for solvers without a matrix, is B in hierarchical
  /// functions: the same function has the same jump.
  void
  check_nodal(const std::string &what,
              const TiedBody    &slave,
              const TiedBody    &master)
  {
    const Assembled modal(slave, master);
    TiedScene       scene(slave, master, MPI_COMM_WORLD, true);
    const IndexSet owned = displacement_indices(scene.spaces[0]->owned_nodes());
    const BulkSystem system(scene.spaces,
                            nullptr,
                            BulkSystem::Scene{scene.field.numbering,
                                              scene.field.constraints},
                            scene.comm);

    mortise::Vector at_nodes;
    system.initialize(at_nodes);
    at_nodes = random(owned, scene.comm);
    for (const unsigned int place : system.levels().front().constrained)
      at_nodes.begin()[place] = 0.;
    mortise::Vector u = modal.scene.displacement();
    system.for_each_coefficient(
      at_nodes, [&](const unsigned int b, const Index dof, const double value) {
        const auto i = modal.scene.field.numbering(b, dof);
        if (modal.scene.field.numbering.owned().is_element(i) &&
            !modal.scene.field.constraints.is_constrained(i))
          u(i) = value;
      });
    const mortise::Vector expected = modal.constraint(u);
    for (const bool with_frames : {false, true})
      {
        CouplingMatrix B =
          assemble_by_node(scene.couplings,
                           {owned, scene.owned_multiplier, scene.comm},
                           with_frames);
        B.constrain(system.levels().front().constrained);
        mortise::Vector jump(expected);
        B.vmult(jump, at_nodes);
        jump -= expected;
        verdict(what + ": at nodes as in hierarchical functions" +
                  (with_frames ? ", with frames 1e-12" : " 1e-12"),
                jump.linfty_norm() / expected.linfty_norm(),
                1e-12);
        mortise::Vector force(at_nodes);
        force = 0.;
        B.Tvmult_add(force, expected);
        const double work = force * at_nodes, of_jump = expected * expected;
        verdict(what + ": the forces do the multipliers' work" +
                  (with_frames ? ", with frames 1e-12" : " 1e-12"),
                std::fabs(work / of_jump - 1.),
                1e-12);
      }
  }

  void
  check_nodal_scenes()
  {
    const std::vector<Held> rim   = {{"xmin", {{true, true, true}}},
                                     {"ymin", {{false, true, false}}}};
    TiedBody                slave = lower(3), master = upper(2);
    slave.dirichlet = master.dirichlet = rim;
    check_nodal("hexahedra", slave, master);
    slave.mesh.refine_near  = "0, 0, 1, 0.1, 2; 1, 1, 1, 0.1, 1";
    master.mesh.refine_near = "1, 0, 1, 0.1, 1";
    check_nodal("hanging nodes", slave, master);
    slave                   = lower(2);
    slave.mesh.subdivisions = {4, 2, 2};
    slave.degree_by_region  = {{4, 3}, {5, 2}, {6, 4}, {7, 3}};
    check_nodal("mixed degrees", slave, master);
    slave = lower(4, true);
    check_nodal("tetrahedra", slave, upper(3));
  }

  TiedBody
  sphere(const unsigned int p,
         const bool         inner,
         const unsigned int n,
         const bool         tetrahedra)
  {
    TiedBody body{{}, inner ? "outside" : "inside", p, {}, {}};
    body.mesh.source = "shell octant";
    body.mesh.extent =
      inner ? std::vector<double>{1., 1.5} : std::vector<double>{1.5, 2.};
    body.mesh.subdivisions = {n, 1};
    body.mesh.cells        = tetrahedra ? "tetrahedra" : "auto";
    return body;
  }

  /// |B x - int lambda (x_slave - x_master)|, relative to int lambda x: what
  /// linear fields become is the gap.
  double
  gap_difference(const Assembled &tied, const double position)
  {
    const Field identity = [](const Point<dim> &x) {
      return Tensor<1, dim>(x);
    };
    mortise::Vector residual =
      tied.constraint(tied.interpolate(identity, identity));
    const Coupling &coupling = tied.scene.coupling();
    IndexSet        relevant = residual.locally_owned_elements();
    for (const auto &rows : coupling.multipliers->rows())
      relevant.add_indices(rows.index.begin(), rows.index.end());
    mortise::Vector gap(residual.locally_owned_elements(),
                        relevant,
                        tied.scene.comm);
    for (unsigned int s = 0; s < coupling.local.size(); ++s)
      {
        const auto        &rows = coupling.multipliers->rows()[s];
        const unsigned int n    = coupling.local[s].mass.m();
        for (unsigned int r = 0; r + 1 < rows.begin.size(); ++r)
          for (unsigned int e = rows.begin[r]; e < rows.begin[r + 1]; ++e)
            gap(rows.index[e]) +=
              rows.weight[e] * coupling.local[s].gap_moment[r % n][r / n];
      }
    gap.compress(VectorOperation::add);
    residual += gap;
    return residual.linfty_norm() / position;
  }

  void
  check_curved()
  {
    for (const bool tetrahedra : {false, true})
      for (const unsigned int p : {1, 2, 3})
        {
          const std::string what = std::string("sphere of ") +
                                   (tetrahedra ? "tetrahedra" : "hexahedra") +
                                   ", p = " + std::to_string(p);
          std::vector<double> errors;
          for (const unsigned int n : {2, 4})
            {
              const Assembled   tied(sphere(p, true, n, tetrahedra),
                                   sphere(p, false, 3 * n / 2, false));
              const std::string mesh = what + ", " + std::to_string(n);
              verdict(mesh + ": B u of constants 1e-13",
                      tied.residual(polynomial(0)),
                      1e-13);
              mortise::Vector one_side = tied.scene.displacement();
              tied.scene.interpolate(0, polynomial(1), one_side);
              verdict(mesh + ": B u of linear fields is the gap 1e-12",
                      gap_difference(tied,
                                     tied.constraint(one_side).linfty_norm()),
                      1e-12);
              const auto transfer = transfer_errors(tied.scene.coupling(),
                                                    tied.scene.owned_multiplier,
                                                    tied.scene.comm);
              verdict(mesh + ": partition of unity 1e-13",
                      transfer.partition_of_unity,
                      1e-13);
              errors.push_back(transfer.linear_completeness);
              const auto balance =
                resultants(tied.scene.coupling(),
                           random(tied.scene.owned_multiplier, tied.scene.comm),
                           tied.scene.comm);
              verdict(mesh + ": force 1e-13", balance.force_residual, 1e-13);
              verdict(mesh + ": moment within the gap",
                      balance.moment_residual,
                      errors.back());
            }
          verdict(what + ": rate of linear completeness at least " +
                    std::to_string(p) + " - 0.3",
                  p - rate(errors[0], errors[1]),
                  0.3);
        }
    // coinciding faces: no gap
    const Assembled tied(sphere(3, true, 2, false), sphere(3, false, 2, false));
    for (const unsigned int degree : {0, 1})
      verdict("matching sphere: B u of degree " + std::to_string(degree) +
                " 1e-12",
              tied.residual(polynomial(degree)),
              1e-12);
  }
} // namespace mortise::testing

int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  mortise::testing::check_flat_meshes();
  mortise::testing::check_distorted();
  mortise::testing::check_rims();
  mortise::testing::check_partial();
  mortise::testing::check_nodal_scenes();
  mortise::testing::check_curved();
}
