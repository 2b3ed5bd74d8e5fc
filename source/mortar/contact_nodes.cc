// See contact_nodes.h.
#include <mortise/mortar/contact_nodes.h>
#include <mortise/mortar/coupling.h>
#include <mortise/mortar/nodal_block.h>

#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "multiplier_sums.h"

namespace mortise
{
  using namespace dealii;

  namespace
  {
    using Index = MultiplierSpace::Index;

    /// Where their entries are in sums.
    enum
    {
      area_sum,
      gap_sum,
      stiffness_sum,
      force_sum,
      moment_sum   = force_sum + dim,
      place_sum    = moment_sum + dim,
      pressure_sum = place_sum + dim,
      pressed_sum,
      pressure_force_sum,
      kinematic_sum = pressure_force_sum + dim,
      normal_sum    = kinematic_sum + dim,
      rotation_sum  = normal_sum + dim,
      share_sum     = rotation_sum + dim * dim, ///< of these two
      n_normal_sums
    };

    /// Of the square of a normal: less of it is rounding and curvature.
    constexpr double least_free_part = 1e-6;

    /// The smallest rotation from one unit vector to another.
    Tensor<2, dim>
    smallest_rotation(const Tensor<1, dim> &from, const Tensor<1, dim> &to)
    {
      const Tensor<1, dim> axis = cross_product_3d(from, to);
      Tensor<2, dim>       across, result;
      for (unsigned int c = 0; c < dim; ++c)
        {
          across[c][(c + 1) % dim] = -axis[(c + 2) % dim];
          across[(c + 1) % dim][c] = axis[(c + 2) % dim];
          result[c][c]             = 1.;
        }
      return result + across + across * across / (1. + from * to);
    }

    /// int phi_i phi_k of the nodal functions phi of slave face @p s.
    FullMatrix<double>
    nodal_mass(const Coupling &coupling, const unsigned int s)
    {
      const FaceTrace &trace = coupling.interface->slave().traces[s];
      const auto      &functions =
        face_nodal_basis(trace.shape, trace.degree).functions;
      FullMatrix<double> by_mode(functions.n(), functions.n()), result(by_mode);
      functions.Tmmult(by_mode, coupling.local[s].mass);
      by_mode.mmult(result, functions);
      return result;
    }

    /// By node: int psi_i n, and int psi_i n n^T.
    using NormalIntegrals =
      std::vector<std::pair<Tensor<1, dim>, Tensor<2, dim>>>;

    /// Of the normals n of slave face @p s, interpolated between nodes.
    NormalIntegrals
    normal_integrals(const Coupling &coupling, const unsigned int s)
    {
      const LocalCoupling &local  = coupling.local[s];
      const auto          &frames = coupling.frames[s];
      NormalIntegrals      result(frames.size());
      if (local.partners.empty())
        return result;
      FullMatrix<double> weights(frames.size(), frames.size());
      if (local.is_dual())
        for (unsigned int i = 0; i < weights.m(); ++i)
          weights(i, i) = local.weights[i];
      else
        weights = nodal_mass(coupling, s);
      for (unsigned int i = 0; i < weights.m(); ++i)
        for (unsigned int k = 0; k < weights.m(); ++k)
          if (weights(i, k) != 0.)
            {
              const Tensor<1, dim> &normal = frames[k][0];
              result[i].first += weights(i, k) * normal;
              result[i].second += weights(i, k) * outer_product(normal, normal);
            }
      return result;
    }

    /// On a slave face, the means of rotations of normals that the coefficients
    /// of multipliers are: of dual ones with the weights phi_i, of standard
    /// ones values at nodes, and of all where pressures are normal at points.
    class MeanRotations
    {
    public:
      MeanRotations(const Coupling &coupling, const unsigned int s)
        : frames(coupling.frames[s])
        , weights(frames.size(), frames.size())
      {
        const LocalCoupling &local = coupling.local[s];
        for (unsigned int i = 0; i < weights.m(); ++i)
          weights(i, i) = 1.;
        if (!local.is_dual() || local.is_directed())
          return;
        weights = nodal_mass(coupling, s);
        for (unsigned int i = 0; i < weights.m(); ++i)
          for (unsigned int k = 0; k < weights.m(); ++k)
            weights(i, k) /= local.weights[i];
      }

      /// Of the rotations from the unit vector @p normal, with the weights
      /// @p of_values of the coefficients at nodes.
      Tensor<2, dim>
      from(const Tensor<1, dim>      &normal,
           const std::vector<double> &of_values) const
      {
        Tensor<2, dim> result;
        for (unsigned int i = 0; i < weights.m(); ++i)
          for (unsigned int k = 0; k < weights.m() && of_values[i] != 0.; ++k)
            if (weights(i, k) != 0.)
              result += of_values[i] * weights(i, k) *
                        smallest_rotation(normal, frames[k][0]);
        return result;
      }

      /// The direction of the mean of the normals at nodes.
      Tensor<1, dim>
      normal(const std::vector<double> &of_values) const
      {
        Tensor<1, dim> sum;
        for (unsigned int i = 0; i < weights.m(); ++i)
          sum += of_values[i] * frames[i][0];
        return sum / sum.norm();
      }

    private:
      const std::vector<Frame> &frames;
      FullMatrix<double>        weights;
    };

    /// The normals and mean rotations of multipliers, each a mean over faces.
    /// Collective.
    void
    add_directions(const Coupling      &coupling,
                   const IndexSet      &owned_multiplier,
                   const MPI_Comm       comm,
                   std::vector<Vector> &sums)
    {
      std::vector<MeanRotations> of_faces;
      for (unsigned int s = 0; s < coupling.local.size(); ++s)
        of_faces.emplace_back(coupling, s);
      const auto add = [&](const unsigned int         s,
                           const std::vector<double> &of_values,
                           const double               weight,
                           const Index                index) {
        const Tensor<1, dim> normal = of_faces[s].normal(of_values);
        const Tensor<2, dim> mean   = of_faces[s].from(normal, of_values);
        for (unsigned int c = 0; c < dim; ++c)
          {
            sums[normal_sum + c](index) += weight * normal[c];
            for (unsigned int d = 0; d < dim; ++d)
              sums[rotation_sum + dim * c + d](index) += weight * mean[c][d];
          }
        sums[share_sum](index) += weight;
      };
      // Bernstein coefficients of edges and insides, then values at nodes
      Vector is_coefficient = make_sums(1, coupling, owned_multiplier, comm)[0];
      for (unsigned int s = 0; s < of_faces.size(); ++s)
        if (!coupling.local[s].partners.empty())
          for (const auto &coefficient :
               coupling.multipliers->rows()[s].coefficients)
            {
              add(s, coefficient.of_values, 1., coefficient.index);
              is_coefficient(coefficient.index) += 1.;
            }
      is_coefficient.compress(VectorOperation::add);
      is_coefficient.update_ghost_values();
      // what is a part of other values alone counts as these do
      constexpr double of_parts = 1e-12;
      for_each_entry(coupling,
                     [&](const unsigned int s,
                         const unsigned int r,
                         const auto         index,
                         const double       w) {
                       if (is_coefficient(index) > 0.)
                         return;
                       const auto &rows     = coupling.multipliers->rows()[s];
                       const unsigned int n = rows.n_nodes(), i = r % n;
                       const bool         is_whole =
                         rows.begin[r + 1] == rows.begin[r] + 1;
                       std::vector<double> one(n);
                       one[i] = 1.;
                       add(s,
                           one,
                           (is_whole ? 1. : of_parts * w * w) *
                             (coupling.local[s].is_dual() ?
                                coupling.local[s].weights[i] :
                                1.),
                           index);
                     });
    }

    std::vector<Vector>
    sums_by_multiplier(const Coupling &coupling,
                       const IndexSet &owned_multiplier,
                       const MPI_Comm  comm)
    {
      auto sums = make_sums(n_normal_sums, coupling, owned_multiplier, comm);
      const bool                   by_component = coupling.law.has_friction();
      std::vector<NormalIntegrals> of_normals;
      for (unsigned int s = 0; s < coupling.local.size() && by_component; ++s)
        of_normals.push_back(normal_integrals(coupling, s));
      for_each_part(coupling,
                    [&](const unsigned int    s,
                        const unsigned int    i,
                        const Tensor<1, dim> &direction,
                        const auto            index,
                        const double          w) {
                      const LocalCoupling &local = coupling.local[s];
                      const double         own   = integral(coupling, s, i),
                                   along =
                                     by_component ?
                                       1. :
                                       direction * coupling.frames[s][i][0];
                      Tensor<1, dim> normal, presses; // weighted with psi
                      if (by_component)
                        {
                          normal  = w * of_normals[s][i].first;
                          presses = w * (of_normals[s][i].second * direction);
                        }
                      sums[area_sum](index) += w * own * along;
                      sums[gap_sum](index) +=
                        w * opening(coupling, s, i, direction);
                      sums[stiffness_sum](index) +=
                        w * own * along * local.penalty;
                      sums[pressure_sum](index) +=
                        by_component ? normal * direction : w * own * along;
                      sums[pressed_sum](index) +=
                        by_component ? presses * direction : w * own * along;
                      const Tensor<1, dim> &place = local.places()[i];
                      const auto            about_origin =
                        cross_product_3d(local.position_moment[i], direction);
                      for (unsigned int c = 0; c < dim; ++c)
                        {
                          sums[force_sum + c](index) += w * own * direction[c];
                          sums[moment_sum + c](index) += w * about_origin[c];
                          sums[place_sum + c](index) += w * along * place[c];
                          sums[pressure_force_sum + c](index) += presses[c];
                          sums[kinematic_sum + c](index) += normal[c];
                        }
                    });
      if (by_component)
        add_directions(coupling, owned_multiplier, comm, sums);
      for (auto &sum : sums)
        sum.compress(VectorOperation::add);
      return sums;
    }

    /// Numbers of owned multipliers of the coupling by node, in the order of
    /// the first of each.
    std::vector<std::vector<unsigned int>>
    multipliers_of_nodes(const MultiplierSpace &multipliers)
    {
      std::vector<std::vector<unsigned int>>                  result;
      std::map<dealii::types::global_dof_index, unsigned int> number;
      const auto &nodes = multipliers.nodes();
      for (unsigned int k = 0; k < nodes.size(); ++k)
        {
          const auto found = number.emplace(nodes[k], result.size());
          if (found.second)
            result.emplace_back();
          result[found.first->second].push_back(k);
        }
      return result;
    }

    /// From entry @p i of the @p sums from @p first on.
    Tensor<1, dim>
    vector_of(const std::vector<Vector> &sums,
              const unsigned int         first,
              const unsigned int         i)
    {
      Tensor<1, dim> result;
      for (unsigned int c = 0; c < dim; ++c)
        result[c] = sums[first + c].local_element(i);
      return result;
    }

    /// Set the directions of a node with friction from the sums @p all of the
    /// multiplier at @p own, which has no part of a rim.
    void
    set_directions(const std::vector<Vector> &all,
                   const unsigned int         own,
                   ContactNode               &node)
    {
      const double   share = all[share_sum].local_element(own);
      Tensor<2, dim> rotation; // in space
      for (unsigned int c = 0; c < dim; ++c)
        rotation[c] = vector_of(all, rotation_sum + dim * c, own) / share;
      const Tensor<1, dim> normal = vector_of(all, normal_sum, own),
                           mean   = rotation * normal / normal.norm();
      node.normal                 = node.along_axes(mean);
      const double length         = node.normal.norm();
      if (length * length < least_free_part)
        {
          node.normal = 0.;
          return;
        }
      node.normal /= length;
      node.length_of_mean = mean.norm();
      const Tensor<1, dim> kinematic =
        node.along_axes(vector_of(all, kinematic_sum, own));
      node.kinematic =
        smallest_rotation(node.normal, kinematic / kinematic.norm());
      node.area = 0.;
      for (unsigned int r = 0; r < node.n_multipliers; ++r)
        node.area += std::pow(node.normal[r], 2) * node.areas[r];
      // between tangents; the identity along the normal, and for components
      // that have no multiplier
      Tensor<2, dim> of_tangents;
      for (unsigned int c = 0; c < dim; ++c)
        {
          Tensor<1, dim> unit;
          unit[c]                       = 1.;
          const Tensor<1, dim> in_space = node.in_space(node.tangential(unit));
          of_tangents[c] =
            c < node.n_multipliers ?
              node.tangential(node.along_axes(rotation * in_space)) +
                node.normal[c] * node.normal :
              unit;
        }
      node.rotation = transpose(of_tangents);
    }
  } // namespace

  std::vector<ContactNode>
  contact_nodes(const Coupling &coupling,
                const IndexSet &owned_multiplier,
                const MPI_Comm  comm)
  {
    if (owned_multiplier.size() == 0)
      return {};
    const auto sums  = sums_by_multiplier(coupling, owned_multiplier, comm);
    const auto first = coupling.multipliers->first();
    const auto local = [&](const unsigned int k) {
      return sums[area_sum].get_partitioner()->global_to_local(first + k);
    };
    std::vector<ContactNode> result;
    for (const auto &of_node : multipliers_of_nodes(*coupling.multipliers))
      {
        ContactNode &node = result.emplace_back();
        unsigned int own  = local(of_node.front());
        for (const unsigned int k : of_node)
          {
            const unsigned int i = local(k), r = node.n_multipliers++;
            node.multipliers[r]     = coupling.multipliers->range().first + k;
            node.areas[r]           = sums[area_sum].local_element(i);
            node.forces[r]          = vector_of(sums, force_sum, i);
            node.moments[r]         = vector_of(sums, moment_sum, i);
            node.pressures[r]       = sums[pressure_sum].local_element(i);
            node.pressed_areas[r]   = sums[pressed_sum].local_element(i);
            node.pressure_forces[r] = vector_of(sums, pressure_force_sum, i);
            node.opening[r] = sums[gap_sum].local_element(i) / node.areas[r];
            // others have a part of a rim as well
            if (node.areas[r] < sums[area_sum].local_element(own))
              own = i;
          }
        node.area     = sums[area_sum].local_element(own);
        node.position = Point<dim>(vector_of(sums, place_sum, own) / node.area);
        node.complementarity =
          sums[stiffness_sum].local_element(own) / node.area;
        if (coupling.law.has_friction())
          set_directions(sums, own, node);
        else
          {
            node.normal[0] = 1.;
            node.kinematic = unit_symmetric_tensor<dim>();
          }
      }
    return result;
  }
} // namespace mortise
