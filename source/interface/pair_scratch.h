// What PairIntegrator keeps between pairs, and the two ways to integrate one. It is private to
// this folder: no other room includes it.
#pragma once

#include <mortise/interface/clipping.h>
#include <mortise/interface/integration_cells.h>

#include <vector>

namespace mortise
{
  struct PairIntegrator::Scratch
  {
    SlaveMap    slave;
    FaceFrame   slave_frame;
    bool        slave_linear = false;
    double      slave_size = 0, slave_area = 0;
    double      search_fraction = default_search_fraction, gap_limit = 0;
    unsigned    n_points = 0;
    MasterMap   master;
    LoopClipper clipper;

    std::vector<double> xi[2], reference_weight; ///< points before mapping
    std::vector<double> gamma[2], gamma_rate[2]; ///< points on curved pieces
  };

  /// Parallelograms with one normal: everything is linear and in closed form.
  PairResult
  integrate_linear_pair(PairIntegrator::Scratch &scratch,
                        const SurfaceFace       &master,
                        const GaussRule         &rule,
                        IntegrationPoints       &points);

  /// All other pairs.
  PairResult
  integrate_curved_pair(PairIntegrator::Scratch &scratch,
                        const SurfaceFace       &master,
                        const GaussRule         &rule,
                        IntegrationPoints       &points);
} // namespace mortise
