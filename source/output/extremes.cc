#include <deal.II/base/mpi.h>

#include <mortise/base/of_all_ranks.h>
#include <mortise/material/nonlinear_law.h>
#include <mortise/operators/cells/cell_fields.h>
#include <mortise/output/extremes.h>
#include <mortise/output/fields.h>
#include <mortise/output/lagrange_cells.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Values that differ by less are one peak: its place must not depend on
    /// rounding.
    constexpr double same_peak = 1e-6;

    /// Nodes of a cell with @p element.
    Quadrature<dim>
    nodes_of(const FiniteElement<dim> &element, const bool tetrahedra)
    {
      const unsigned int degree = element.degree;
      if (!tetrahedra)
        return Quadrature<dim>(QGaussLobatto<1>(degree + 1));
      std::vector<Point<dim>> points;
      for (const auto &node :
           lagrange_nodes(LagrangeShape::tetrahedron, degree))
        points.emplace_back(double(node[0]) / degree,
                            double(node[1]) / degree,
                            double(node[2]) / degree);
      return Quadrature<dim>(points);
    }

    /// By which of several places that have the same value one is taken: no two
    /// that a symmetric mesh makes have the same order.
    double
    order(const Point<dim> &place)
    {
      return place[0] + 0.7548776662466927 * place[1] +
             0.5698402909980532 * place[2];
    }

    /// The first of the places that are given.
    class FirstPlace
    {
    public:
      void
      add(const Point<dim> &other)
      {
        if (none || order(other) < order(place))
          place = other;
        none = false;
      }

      /// Of all ranks. Collective.
      Point<dim>
      over_ranks(const MPI_Comm comm) const
      {
        FirstPlace first;
        for (const auto &[is_none, other] :
             Utilities::MPI::all_gather(comm, std::make_pair(none, place)))
          if (!is_none)
            first.add(other);
        return first.place;
      }

    private:
      bool       none = true;
      Point<dim> place;
    };

    /// At one point, the largest one of a cell, and so on.
    struct Sizes
    {
      double displacement = 0., von_mises = 0., plastic_strain = 0.;

      void
      add(const Sizes &other)
      {
        // what is no number is found in the sums of other results
        displacement   = std::max(displacement, other.displacement);
        von_mises      = std::max(von_mises, other.von_mises);
        plastic_strain = std::max(plastic_strain, other.plastic_strain);
      }
    };

    Sizes
    sizes_at(const CellFields &fields, const unsigned int q)
    {
      return {fields.values[q].norm(),
              von_mises(fields.stress(q)),
              fields.plastic_strain(q)};
    }

    /// The node that a cell has at a place, by its stress.
    struct StressAt
    {
      unsigned int            place = 0;
      SymmetricTensor<2, dim> stress;

      template <class Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &place;
        archive &stress;
      }
    };

    /// What is evaluated on the cells of a body.
    class LargestValues
    {
    public:
      LargestValues(const Body &body, const BodySolution &solution)
        : body(body)
        , solution(solution)
        , comm(body.triangulation().get_communicator())
        , fields(body, [&](const auto &element) {
          return nodes_of(element, body.mesh.tetrahedra);
        })
      {}

      /// The largest values of each owned cell, then the first places of those
      /// of all. Collective.
      Extremes
      peaks()
      {
        std::vector<Sizes> of_cells;
        Sizes              largest;
        for_each_cell([&](const auto &cell) {
          fields.reinit(cell, solution);
          Sizes sizes;
          for (unsigned int q = 0; q < fields.points.size(); ++q)
            sizes.add(sizes_at(fields, q));
          of_cells.push_back(sizes);
          largest.add(sizes);
        });
        largest.displacement = Utilities::MPI::max(largest.displacement, comm);
        largest.von_mises    = Utilities::MPI::max(largest.von_mises, comm);
        largest.plastic_strain =
          Utilities::MPI::max(largest.plastic_strain, comm);
        const auto is_peak = [](const double value, const double most) {
          return value >= (1. - same_peak) * most;
        };
        FirstPlace displacement, von_mises, plastic_strain;
        auto       of_cell = of_cells.cbegin();
        for_each_cell([&](const auto &cell) {
          const Sizes &most = *of_cell++;
          if (!is_peak(most.displacement, largest.displacement) &&
              !is_peak(most.von_mises, largest.von_mises) &&
              !is_peak(most.plastic_strain, largest.plastic_strain))
            return;
          fields.reinit(cell, solution);
          for (unsigned int q = 0; q < fields.points.size(); ++q)
            {
              const Sizes sizes = sizes_at(fields, q);
              if (is_peak(sizes.displacement, largest.displacement))
                displacement.add(fields.points[q]);
              if (is_peak(sizes.von_mises, largest.von_mises))
                von_mises.add(fields.points[q]);
              if (is_peak(sizes.plastic_strain, largest.plastic_strain))
                plastic_strain.add(fields.points[q]);
            }
        });
        Extremes result;
        result.displacement.value = largest.displacement;
        result.von_mises.value    = largest.von_mises;
        result.displacement.at    = coordinates(displacement.over_ranks(comm));
        if (body.material.nonlinear() &&
            body.material.nonlinear()->plastic_strain())
          result.plastic_strain = {largest.plastic_strain,
                                   coordinates(
                                     plastic_strain.over_ranks(comm))};
        const Point<dim> peak = von_mises.over_ranks(comm);
        result.von_mises.at   = coordinates(peak);
        compare_cells(peak, result.von_mises);
        return result;
      }

    private:
      template <typename Visit>
      void
      for_each_cell(const Visit &visit) const
      {
        for (const auto &cell : body.dof_handler.active_cell_iterators())
          if (cell->is_locally_owned())
            visit(cell);
      }

      static std::vector<double>
      coordinates(const Point<dim> &x)
      {
        return {x[0], x[1], x[2]};
      }

      /// Calls @p visit(cell) for those with a node within @p radius of @p place, and maybe others.
      template <typename Visit>
      void
      for_each_cell_near(const Point<dim> &place,
                         const double      radius,
                         const Visit      &visit) const
      {
        for_each_cell([&](const auto &cell) {
          // a corner of a tetrahedron is at most 3/4 of its longest edge from
          // its centre, the sides of a quarter of a circle bulge by 1/5
          if (cell->center().distance(place) <= cell->diameter() + radius)
            visit(cell);
        });
      }

      /// Corners of the cells that have a node at @p place. Collective.
      std::vector<Point<dim>>
      corners_around(const Point<dim> &place)
      {
        std::vector<Point<dim>> own;
        for_each_cell_near(place, 0., [&](const auto &cell) {
          fields.reinit(cell, solution);
          const double rounding = same_place * cell->diameter();
          if (std::any_of(fields.points.begin(),
                          fields.points.end(),
                          [&](const Point<dim> &node) {
                            return node.distance(place) <= rounding;
                          }))
            for (unsigned int v = 0; v < cell->n_vertices(); ++v)
              own.push_back(cell->vertex(v));
        });
        return of_all_ranks(own, comm);
      }

      /// What cells that meet say of the stress at @p peak and at the corners
      /// of those that have it.
      void
      compare_cells(const Point<dim> &peak, StressPeakSummary &result)
      {
        std::vector<Point<dim>>       places  = {peak};
        const std::vector<Point<dim>> corners = corners_around(peak);
        double                        radius  = 0.;
        for (const Point<dim> &corner : corners)
          radius = std::max(radius, corner.distance(peak));
        const double rounding = same_place * radius;
        const auto   number   = [&](const Point<dim> &x) -> unsigned int {
          for (unsigned int i = 0; i < places.size(); ++i)
            if (std::fabs(places[i][0] - x[0]) <= rounding &&
                places[i].distance(x) <= rounding)
              return i;
          return places.size();
        };
        for (const Point<dim> &corner : corners)
          if (number(corner) == places.size())
            places.push_back(corner);

        std::vector<StressAt> own;
        for_each_cell_near(peak, radius, [&](const auto &cell) {
          fields.reinit(cell, solution);
          for (unsigned int q = 0; q < fields.points.size(); ++q)
            if (const unsigned int i = number(fields.points[q]);
                i < places.size())
              own.push_back({i, fields.stress(q)});
        });
        std::vector<std::vector<SymmetricTensor<2, dim>>> by_place(
          places.size());
        for (const StressAt &node : of_all_ranks(own, comm))
          by_place[node.place].push_back(node.stress);

        SymmetricTensor<2, dim> mean;
        for (const auto &stress : by_place[0])
          mean += stress / double(by_place[0].size());
        result.averaged = von_mises(mean);
        for (const auto &stresses : by_place)
          for (unsigned int a = 1; a < stresses.size(); ++a)
            for (unsigned int b = 0; b < a; ++b)
              result.jump = std::max(result.jump.value_or(0.),
                                     von_mises(stresses[a] - stresses[b]));
      }

      /// Beside the size of cells.
      static constexpr double same_place = 1e-6;

      const Body         &body;
      const BodySolution &solution;
      const MPI_Comm      comm;
      CellFields          fields;
    };
  } // namespace

  Extremes
  extremes(const Body &body, const BodySolution &solution)
  {
    return LargestValues(body, solution).peaks();
  }
} // namespace mortise
