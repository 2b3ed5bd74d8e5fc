// What acts on the bodies of a deck: supports, loads, temperatures, and the
// sides of interfaces, as boundaries of a scene. A scene has one boundary for
// each face: faces with the same conditions are one.
#pragma once

#include <array>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "import_bodies.h"
#include "import_history.h"
#include "import_material.h"
#include "import_remarks.h"

namespace mortise
{
  /// A force on faces, with its moment about their centroid.
  struct ImportForce
  {
    std::array<ImportHistory, 3> force, moment;
    double                       area = 0.;
    dealii::Point<3>             centroid;
    dealii::Tensor<2, 3>         inertia; ///< of the area about its centroid
  };

  struct ImportCondition
  {
    enum class Kind
    {
      support,
      pressure,
      traction,
      force,
      side ///< of an interface
    };

    Kind                         kind;
    std::string                  name; ///< of the set or surface of the deck
    unsigned int                 component = 0; ///< of a support
    std::string                  axes;          ///< of a support; empty: none
    AffineHistory                value;         ///< of a support or pressure
    std::array<ImportHistory, 3> traction;
    ImportForce                  force;
  };

  class ImportConditions
  {
  public:
    ImportConditions(ImportBodies      &bodies,
                     const ImportSteps &steps,
                     ImportRemarks     &remarks);

    /// Add a condition to @p faces; its number.
    unsigned int
    add(const ImportCondition           &condition,
        const std::vector<unsigned int> &faces);

    /// Give each face with conditions the name of its boundary; all faces of a
    /// body without any are "skin".
    void
    name_boundaries();

    /// Sections Boundary of a body.
    std::string
    boundaries_text(unsigned int body) const;

    /// Body force of a body.
    std::string
    body_text(unsigned int body, const ImportMaterial &material) const;

    /// Temperature of a body above the initial one, empty if there is none.
    std::string
    temperature_text(unsigned int body) const;

    /// Is a face of a body with a condition held in any component?
    bool
    is_held(unsigned int body, unsigned int condition) const;

    /// "body: boundary, boundary" of the faces with a condition, empty if it
    /// has none.
    std::string
    side_text(unsigned int body, unsigned int condition) const;

    /// Entries of Output/Resultants: all that is held.
    std::string
    resultants_text() const;

  private:
    struct Supported ///< a component of a node
    {
      std::vector<ImportChange> changes;
      unsigned int              source;
    };
    struct Source ///< of prescribed displacements: a set, or single nodes
    {
      std::string                              name, place;
      std::set<unsigned int>                   nodes;
      std::array<std::vector<ImportChange>, 3> changes;
    };
    struct NodalForce
    {
      std::vector<ImportChange> changes;
      std::string               name, place;
    };
    struct BodyForce
    {
      std::string               place, kind;
      std::vector<unsigned int> bodies;
      std::vector<double>       numbers; ///< after the magnitude
      std::vector<ImportChange> changes;
    };
    struct FaceLoad
    {
      ImportCondition           condition;
      std::vector<unsigned int> faces;
      std::vector<double>       direction; ///< of a traction
      std::vector<ImportChange> changes;
    };

    void
    read(const InpBlock &block, std::size_t step);
    void
    read_boundary(const InpBlock &block, std::size_t step);
    void
    prescribe(const InpBlock &block,
              const InpLine  &line,
              unsigned int    component,
              double          value,
              std::size_t     step);
    void
    read_nodal_forces(const InpBlock &block, std::size_t step);
    void
    read_loads(const InpBlock &block, std::size_t step);
    void
    read_face_load(const InpBlock &block,
                   const InpLine  &line,
                   std::size_t     step);
    void
    read_body_force(const InpBlock &block,
                    const InpLine  &line,
                    std::size_t     step);
    void
    read_temperatures(const InpBlock &block, std::size_t step);

    void
    tell_released_supports();
    std::vector<unsigned int>
    held_faces(unsigned int component) const;
    void
    find_supports();
    void
    find_affine_supports(unsigned int                     component,
                         const std::vector<unsigned int> &faces);
    void
    find_forces();
    void
    add_force(const std::vector<unsigned int> &faces,
              const std::set<unsigned int>    &nodes);
    ImportForce
    area_of(const std::vector<unsigned int> &faces) const;

    ImportBodies      &bodies;
    const InpDeck     &deck;
    const ImportSteps &steps;
    ImportRemarks     &remarks;

    std::vector<Source> sources;
    std::map<std::size_t, std::string>
      new_supports; ///< places of OP=NEW, by step
    std::array<std::map<unsigned int, Supported>, 3> supported; ///< by node
    std::map<unsigned int, std::string> local_axes; ///< of *TRANSFORM, by node
    std::array<std::map<unsigned int, NodalForce>, 3> nodal_forces;
    std::map<std::string, FaceLoad>                   face_loads;
    std::map<std::string, BodyForce>                  body_forces;
    std::map<unsigned int, double>                    initial;
    std::map<unsigned int, std::vector<ImportChange>> temperatures;
    std::vector<ImportCondition>                      conditions;
  };
} // namespace mortise
