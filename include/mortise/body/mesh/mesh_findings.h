// What is wrong with the mesh of a file, and what is worth knowing of it: all
// at once, each kind with its number and its first places. It knows no mesh.
#pragma once

#include <deal.II/base/point.h>

#include <mortise/base/error.h>

#include <deque>
#include <set>
#include <string>
#include <vector>

namespace mortise
{
  /// "(x, y, z)".
  std::string
  place_name(const dealii::Point<3> &x);

  /// Faults of one kind.
  struct MeshFinding
  {
    bool                     is_error = false; ///< else a warning
    std::string              what;             ///< in the plural
    std::string              remedy; ///< "allowed: ...", or what becomes of it
    std::size_t              count = 0;
    std::vector<std::string> places; ///< the first few
    std::set<std::string>    named;  ///< who was found so far

    /// One more of them: @p who ("cell 17"), the first time that it is named,
    /// at the point @p x of the file.
    void
    at(const std::string &who, const dealii::Point<3> &x);

    /// "cells without volume: 2, cell 17 at (0, 0, 1), ...; allowed: ..."
    std::string
    text() const;

    template <typename Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &is_error &what &remedy &count &places;
    }
  };

  class MeshFindings
  {
  public:
    /// The finding @p what, made if there is none yet. References stay valid.
    MeshFinding &
    error(const std::string &what, const std::string &remedy);
    MeshFinding &
    warning(const std::string &what, const std::string &remedy);

    bool
    has_errors() const;

    /// "  error: ..." and "  warning: ...", a line for each kind, errors first.
    std::vector<std::string>
    lines() const;

    /// The texts of all warnings.
    std::vector<std::string>
    warnings() const;

    template <typename Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &findings;
    }

  private:
    MeshFinding &
    find(bool is_error, const std::string &what, const std::string &remedy);

    std::deque<MeshFinding> findings;
  };

  /// The mesh of a file has errors; the names of its boundaries are known.
  class MeshError : public InputError
  {
  public:
    MeshError(const std::string              &what,
              const std::vector<std::string> &boundaries)
      : InputError(what)
      , boundaries(boundaries)
    {}

    std::vector<std::string> boundaries;
  };
} // namespace mortise
