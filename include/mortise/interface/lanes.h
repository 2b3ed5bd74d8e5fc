// Arithmetic with eight numbers or vectors at a time.
#pragma once

#include <deal.II/base/tensor.h>

#include <mortise/base/register_width.h>

#include <cmath>

namespace mortise
{
  /// Eight numbers that are computed together, in memory where registers are
  /// narrower.
  using Lanes = double __attribute__((vector_size(64)));

  constexpr unsigned int n_lanes = 8;

  /// The lanes that fit a register, for loops that take much time.
  typedef double LanesPart
    __attribute__((vector_size(register_width), may_alias));

  constexpr unsigned int n_lane_parts = sizeof(Lanes) / sizeof(LanesPart);

  inline const LanesPart &
  part_of(const Lanes &a, const unsigned int part)
  {
    return reinterpret_cast<const LanesPart *>(&a)[part];
  }

  inline LanesPart &
  part_of(Lanes &a, const unsigned int part)
  {
    return reinterpret_cast<LanesPart *>(&a)[part];
  }

  /// All lanes equal to @p value.
  inline Lanes
  broadcast(const double value)
  {
    return Lanes{} + value;
  }

  inline Lanes
  absolute(const Lanes &a)
  {
    return a < 0. ? -a : a;
  }

  inline Lanes
  minimum(const Lanes &a, const Lanes &b)
  {
    return a < b ? a : b;
  }

  inline Lanes
  maximum(const Lanes &a, const Lanes &b)
  {
    return a > b ? a : b;
  }

  inline Lanes
  square_root(const Lanes &a)
  {
    Lanes result;
    for (unsigned int l = 0; l < n_lanes; ++l)
      result[l] = std::sqrt(a[l]);
    return result;
  }

  /// Largest entry.
  inline double
  largest(const Lanes &a)
  {
    double result = a[0];
    for (unsigned int l = 1; l < n_lanes; ++l)
      result = a[l] > result ? a[l] : result;
    return result;
  }

  /// Eight vectors in space, or one with T = double.
  template <typename T>
  struct Vec3
  {
    T v[3];

    T &
    operator[](const unsigned int i)
    {
      return v[i];
    }
    const T &
    operator[](const unsigned int i) const
    {
      return v[i];
    }
  };

  template <typename T>
  inline Vec3<T>
  operator+(const Vec3<T> &a, const Vec3<T> &b)
  {
    return {{a[0] + b[0], a[1] + b[1], a[2] + b[2]}};
  }

  template <typename T>
  inline Vec3<T>
  operator-(const Vec3<T> &a, const Vec3<T> &b)
  {
    return {{a[0] - b[0], a[1] - b[1], a[2] - b[2]}};
  }

  template <typename T, typename S>
  inline Vec3<T>
  operator*(const S &s, const Vec3<T> &a)
  {
    return {{s * a[0], s * a[1], s * a[2]}};
  }

  template <typename T, typename S>
  inline T
  dot(const Vec3<T> &a, const Vec3<S> &b)
  {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  }

  template <typename T>
  inline Vec3<T>
  cross(const Vec3<T> &a, const Vec3<T> &b)
  {
    return {{a[1] * b[2] - a[2] * b[1],
             a[2] * b[0] - a[0] * b[2],
             a[0] * b[1] - a[1] * b[0]}};
  }

  inline Vec3<double>
  to_vec3(const dealii::Tensor<1, 3> &a)
  {
    return {{a[0], a[1], a[2]}};
  }

  inline Vec3<Lanes>
  broadcast(const Vec3<double> &a)
  {
    return {{broadcast(a[0]), broadcast(a[1]), broadcast(a[2])}};
  }
} // namespace mortise
