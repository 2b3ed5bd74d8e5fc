// Time and memory of SparseCholesky beside CHOLMOD and MUMPS on the matrices
// that the program factorises, as one line of JSON. Not a test:
// sparse_cholesky.py makes the table of doc/measurements/sparse_cholesky.md of
// it.
//
//   sparse_cholesky [KEY=VALUE]...
//     matrix    multipliers (C = B T B^T) or vertices (K + J of degree one)
//     source    sphere (two layers of an octant, symmetry conditions) or box
//               (two boxes)
//     cells     hexahedra or tetrahedra
//     degree    of both bodies
//     slave, master   subdivisions of the interface along an edge
//     layers    of cells in each body
//     held      sides of the boxes where both are clamped, by commas
//     runs      factorisations of each, in turn; solves: per run
#include <malloc.h>
#include <mortise/operators/bulk_system.h>
#include <mortise/operators/levels/block_csr_matrix.h>
#include <mortise/operators/levels/vertex_matrix.h>
#include <mortise/solvers/factorisation/mumps_factorisation.h>
#include <mortise/solvers/factorisation/sparse_cholesky.h>
#include <mortise/solvers/multipliers/weighted_square.h>

#include <ctime>
#include <iostream>

#include "../mortar/tied_scene.h"

#ifdef MORTISE_CHOLMOD
#  include <cholmod.h>
#endif

using namespace mortise;
using namespace mortise::testing;

namespace
{
  class Options
  {
  public:
    Options(const int argc, char **argv)
    {
      for (int i = 1; i < argc; ++i)
        {
          const std::string text  = argv[i];
          const auto        equal = text.find('=');
          values[text.substr(0, equal)] =
            equal == std::string::npos ? "" : text.substr(equal + 1);
        }
    }

    std::string
    text(const std::string &key, const std::string &otherwise) const
    {
      const auto found = values.find(key);
      return found == values.end() ? otherwise : found->second;
    }

    unsigned int
    number(const std::string &key, const unsigned int otherwise) const
    {
      return std::stoul(text(key, std::to_string(otherwise)));
    }

  private:
    std::map<std::string, std::string> values;
  };

  /// Of this process on the processor, whatever else runs.
  double
  seconds()
  {
    timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return now.tv_sec + 1e-9 * now.tv_nsec;
  }

  /// Memory of this process in MiB.
  double
  allocated()
  {
    const struct mallinfo2 info = mallinfo2();
    return (info.uordblks + info.hblkhd) / 1048576.;
  }

  /// The rows with, by node, the entries of vectors like zero.
  struct Problem
  {
    RowsByNode            rows;
    mortise::Vector       zero;
    mortise::SparseMatrix matrix; ///< of nodes and components
  };

  std::vector<Held>
  held_sides(const std::string &names)
  {
    std::vector<Held>  dirichlet;
    std::istringstream entries(names);
    for (std::string name; std::getline(entries, name, ',');)
      dirichlet.push_back({name, {{true, true, true}}});
    return dirichlet;
  }

  TiedBody
  make_body(const Options &options, const bool slave)
  {
    const unsigned int n = options.number(slave ? "slave" : "master",
                                          slave ? 4 : 5),
                       m = options.number("layers", 1);
    const bool sphere    = options.text("source", "box") == "sphere";
    TiedBody   body;
    body.degree      = options.number("degree", 2);
    body.mesh.cells  = options.text("cells", "hexahedra");
    body.mesh.source = sphere ? "shell octant" : "box";
    body.mesh.extent =
      sphere ?
        (slave ? std::vector<double>{1., 1.5} : std::vector<double>{1.5, 2.}) :
        (slave ? std::vector<double>{0., 0., 0., 1., 1., .5} :
                 std::vector<double>{0., 0., .5, 1., 1., 1.});
    body.mesh.subdivisions = sphere ? std::vector<unsigned int>{n, m} :
                                      std::vector<unsigned int>{n, n, m};
    body.surface =
      sphere ? (slave ? "outside" : "inside") : (slave ? "zmax" : "zmin");
    if (sphere)
      body.dirichlet = {{"xmin", {{true, false, false}}},
                        {"ymin", {{false, true, false}}},
                        {"zmin", {{false, false, true}}}};
    else
      body.dirichlet = held_sides(options.text("held", ""));
    return body;
  }

  Problem
  make_problem(const Options &options)
  {
    TiedScene              scene(make_body(options, true),
                    make_body(options, false),
                    MPI_COMM_WORLD,
                    true);
    const dealii::IndexSet owned =
      displacement_indices(scene.spaces[0]->owned_nodes());
    const BulkSystem::Scene all{scene.field.numbering, scene.field.constraints};
    BulkSystem              system(scene.spaces, nullptr, all, scene.comm);
    system.couple(scene.couplings);
    Problem problem;
    if (options.text("matrix", "multipliers") == "vertices")
      {
        const mortise::SparseMatrix matrix = as_sparse_matrix(
          assemble_vertex_matrix(system.levels().back()).blocks);
        problem.rows = rows_as_nodes(matrix);
        problem.zero.reinit(matrix.rows(), scene.comm);
      }
    else
      {
        CouplingMatrix B =
          assemble_by_node(scene.couplings,
                           {owned, scene.owned_multiplier, scene.comm},
                           false);
        B.constrain(system.levels().front().constrained);
        // as ApproximateSchurComplement
        LevelVector<double> weights(system.node_diagonal());
        for (unsigned int i = 0; i < weights.locally_owned_size(); ++i)
          weights.local_element(i) = 1. / weights.local_element(i);
        for (const auto &leading : system.independent_displacements())
          weights.local_element(leading.index) = 0.;
        problem.rows = weighted_square(RowsByEntity(B), weights);
        problem.zero.reinit(scene.owned_multiplier, scene.comm);
      }
    problem.matrix = as_matrix(problem.rows, scene.comm);
    return problem;
  }

  /// One way to factorise.
  struct Solver
  {
    std::string                                     name;
    std::function<bool()>                           factorise;
    std::function<void(double *x, const double *b)> solve;
    std::function<void()>                           clear;
    std::vector<double>                             factor_times, solve_times;
    double                                          memory = 0., error = 0.;
  };

  template <typename Number, typename Work>
  Solver
  own(const std::string &name, const Problem &problem)
  {
    const auto inverse =
      std::make_shared<std::unique_ptr<SparseCholesky<Number, Work>>>();
    Solver solver;
    solver.name      = name;
    solver.factorise = [=, &problem] {
      *inverse = std::make_unique<SparseCholesky<Number, Work>>();
      return (*inverse)->initialize(problem.rows, MPI_COMM_WORLD);
    };
    solver.solve = [=](double *x, const double *b) { (*inverse)->solve(x, b); };
    solver.clear = [=] { inverse->reset(); };
    return solver;
  }

  Solver
  mumps(const Problem &problem)
  {
    struct State
    {
      std::unique_ptr<MumpsFactorisation> inverse;
      std::vector<double>                 x, b;
    };
    const auto state = std::make_shared<State>();
    state->x.resize(problem.matrix.n_rows());
    state->b.resize(problem.matrix.n_rows());
    Solver solver;
    solver.name      = "mumps";
    solver.factorise = [=, &problem] {
      state->inverse = std::make_unique<MumpsFactorisation>();
      return state->inverse->initialize(problem.matrix,
                                        MatrixKind::positive_definite);
    };
    solver.solve = [=, &problem](double *x, const double *b) {
      const auto &entries = problem.rows.entries;
      for (unsigned int i = 0; i < entries.size(); ++i)
        state->b[i] = entries[i] < 0 ? 0. : b[entries[i]];
      state->inverse->solve(state->x.data(), state->b.data());
      for (unsigned int i = 0; i < entries.size(); ++i)
        if (entries[i] >= 0)
          x[entries[i]] = state->x[i];
    };
    solver.clear = [=] { state->inverse.reset(); };
    return solver;
  }

#ifdef MORTISE_CHOLMOD
  /// CHOLMOD on the rows: as one matrix, or, where all components have the
  /// same rows, on that of one component with all as right hand sides.
  class Cholmod
  {
  public:
    Cholmod(const Problem &problem, const int ordering)
      : rows(problem.rows)
      , alike(std::all_of(rows.variants.begin(),
                          rows.variants.end(),
                          [](const auto n) { return n == 1; }))
    {
      cholmod_start(&common);
      common.supernodal         = CHOLMOD_SUPERNODAL;
      common.nmethods           = 1;
      common.method[0].ordering = ordering;
      common.postorder          = true;
    }

    ~Cholmod()
    {
      clear();
      cholmod_finish(&common);
    }

    bool
    factorise()
    {
      clear();
      const unsigned int C = rows.n_components, m = alike ? 1 : C,
                         n     = rows.size() * m;
      cholmod_triplet *entries = cholmod_allocate_triplet(
        n, n, rows.values.size() * C, -1, CHOLMOD_REAL, &common);
      std::size_t nnz = 0, column = 0, value = 0;
      auto       *i = static_cast<int *>(entries->i),
           *j       = static_cast<int *>(entries->j);
      auto *x       = static_cast<double *>(entries->x);
      for (unsigned int node = 0; node < rows.size(); ++node)
        {
          const unsigned int length = rows.lengths[node];
          for (unsigned int c = 0; c < m; ++c)
            for (unsigned int k = 0; k < length; ++k)
              if (const int other = rows.columns[column + k];
                  other <= static_cast<int>(node))
                {
                  i[nnz] = node * m + c;
                  j[nnz] = other * m + c;
                  x[nnz++] =
                    rows.values[value + k +
                                (rows.variants[node] == 1 ? 0 : c * length)];
                }
          column += length;
          value += std::size_t(rows.variants[node]) * length;
        }
      entries->nnz           = nnz;
      cholmod_sparse *matrix = cholmod_triplet_to_sparse(entries, nnz, &common);
      cholmod_free_triplet(&entries, &common);
      factor = cholmod_analyze(matrix, &common);
      cholmod_factorize(matrix, factor, &common);
      cholmod_free_sparse(&matrix, &common);
      b = cholmod_allocate_dense(n, alike ? C : 1, n, CHOLMOD_REAL, &common);
      return common.status == CHOLMOD_OK;
    }

    void
    solve(double *x, const double *rhs)
    {
      const unsigned int C = rows.n_components, n = rows.size();
      const auto         place = [&](const unsigned int e) {
        return alike ? (e % C) * n + e / C : e;
      };
      auto *to = static_cast<double *>(b->x);
      for (unsigned int e = 0; e < rows.entries.size(); ++e)
        to[place(e)] = rows.entries[e] < 0 ? 0. : rhs[rows.entries[e]];
      cholmod_solve2(
        CHOLMOD_A, factor, b, nullptr, &result, nullptr, &Y, &E, &common);
      const auto *from = static_cast<const double *>(result->x);
      for (unsigned int e = 0; e < rows.entries.size(); ++e)
        if (rows.entries[e] >= 0)
          x[rows.entries[e]] = from[place(e)];
    }

    void
    clear()
    {
      for (cholmod_dense **vector : {&b, &result, &Y, &E})
        cholmod_free_dense(vector, &common);
      cholmod_free_factor(&factor, &common);
    }

  private:
    const RowsByNode &rows;
    const bool        alike;
    cholmod_common    common{};
    cholmod_factor   *factor = nullptr;
    cholmod_dense *b = nullptr, *result = nullptr, *Y = nullptr, *E = nullptr;
  };

  Solver
  cholmod(const std::string &name, const Problem &problem, const int ordering)
  {
    const auto state = std::make_shared<Cholmod>(problem, ordering);
    Solver     solver;
    solver.name      = name;
    solver.factorise = [=] { return state->factorise(); };
    solver.solve     = [=](double *x, const double *b) { state->solve(x, b); };
    solver.clear     = [=] { state->clear(); };
    return solver;
  }
#endif

  double
  median(std::vector<double> values)
  {
    std::nth_element(values.begin(),
                     values.begin() + values.size() / 2,
                     values.end());
    return values[values.size() / 2];
  }

  /// |b - A x| / |b|.
  double
  residual(const Problem         &problem,
           const mortise::Vector &x,
           const mortise::Vector &b)
  {
    mortise::Vector r(problem.zero);
    multiply(problem.rows, problem.matrix, r, x);
    r -= b;
    return r.l2_norm() / b.l2_norm();
  }

  void
  measure(std::vector<Solver> &solvers,
          const Problem       &problem,
          const unsigned int   runs,
          const unsigned int   n_solves)
  {
    mortise::Vector x(problem.zero), b(x);
    for (const auto i : b.locally_owned_elements())
      b(i) = std::sin(1. + 3.7 * i);
    for (unsigned int run = 0; run < runs + 1;
         ++run) // the first is not counted
      for (Solver &solver : solvers)
        {
          const double before = allocated(), start = seconds();
          if (!solver.factorise())
            throw std::runtime_error(solver.name + " failed");
          const double middle = seconds();
          for (unsigned int i = 0; i < n_solves; ++i)
            solver.solve(x.begin(), b.begin());
          const double end = seconds();
          solver.memory    = allocated() - before;
          solver.error     = residual(problem, x, b);
          solver.clear();
          if (run > 0)
            {
              solver.factor_times.push_back(middle - start);
              solver.solve_times.push_back((end - middle) / n_solves);
            }
        }
  }
} // namespace

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const Options                            options(argc, argv);
  const Problem                            problem = make_problem(options);
  std::vector<Solver>                      solvers;
  const bool vertices = options.text("matrix", "multipliers") == "vertices";
  solvers.push_back(vertices ? own<float, float>("own_float", problem) :
                               own<float, double>("own_float", problem));
  solvers.push_back(own<double, double>("own_double", problem));
#ifdef MORTISE_CHOLMOD
  solvers.push_back(cholmod("cholmod_metis", problem, CHOLMOD_METIS));
  solvers.push_back(cholmod("cholmod_amd", problem, CHOLMOD_AMD));
#endif
  solvers.push_back(mumps(problem));
  measure(solvers,
          problem,
          options.number("runs", 5),
          options.number("solves", 20));

  std::size_t n_entries = 0;
  for (unsigned int i = 0; i < problem.matrix.n_rows(); ++i)
    n_entries += problem.matrix.row(i).length;
  const auto alike =
    std::count(problem.rows.variants.begin(), problem.rows.variants.end(), 1u);
  std::cout << "{\"rows\": " << problem.zero.size()
            << ", \"nodes\": " << problem.rows.size()
            << ", \"components\": " << problem.rows.n_components
            << ", \"alike\": " << double(alike) / problem.rows.size()
            << ", \"entries\": " << n_entries;
  for (const Solver &solver : solvers)
    std::cout << ", \"" << solver.name
              << "\": {\"factor\": " << median(solver.factor_times)
              << ", \"solve\": " << median(solver.solve_times)
              << ", \"memory\": " << solver.memory
              << ", \"residual\": " << solver.error << "}";
  std::cout << "}" << std::endl;
}
