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
  /// Nothing is prescribed.
  inline const std::array<std::string, 3> free_components = {{"-", "-", "-"}};

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
      motion,     ///< rigid, of a coupling
      rigid_part, ///< the same, of which forces decide a part
      foundation,
      pressure,
      traction,
      force,
      side ///< of an interface
    };
    static constexpr unsigned int normal = 3; ///< a component

    Kind                 kind;
    std::string          name;          ///< of the set or surface of the deck
    unsigned int         component = 0; ///< of a support
    dealii::Tensor<2, 3> axes;  ///< of a support, by columns; zero: the scene's
    AffineHistory        value; ///< of a support, pressure or foundation
    std::array<ImportHistory, 3> traction; ///< of a motion: its rotation
    /// Of a motion; of a rigid part - is free.
    std::array<std::string, 3> displacement = free_components,
                               rotation     = free_components;
    dealii::Point<3> reference; ///< of both
    ImportForce      force;
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

    /// Points and edges of a body that are held.
    std::string
    supports_text(unsigned int body) const;

    /// The force of a *PRE-TENSION SECTION and since when it is kept, as lines
    /// of an interface; empty if nothing acts.
    std::string
    preload_text(const InpBlock &section);

    /// Temperature of a body above the initial one, empty if there is none.
    std::string
    temperature_text(unsigned int body) const;

    /// Is a face of a body with a condition held in any component?
    bool
    is_held(unsigned int body, unsigned int condition) const;

    /// Faces of a body with a condition that are held across their normals
    /// alone are held along their edges instead: a slave is no held boundary.
    void
    hold_edges(unsigned int       body,
               unsigned int       condition,
               const std::string &place);

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
    struct LocalSystem ///< of *TRANSFORM, at a node
    {
      dealii::Tensor<2, 3> axes;  ///< by columns
      bool                 round; ///< radial, tangential, axial
      double               radius;
    };
    /// The node that a set of nodes follows, or whose load acts on them.
    struct Reference
    {
      std::string place;
      bool        preload = false; ///< of a *PRE-TENSION SECTION
      std::array<std::vector<ImportChange>, 6> motion, load;
      std::size_t fixed_from = 0; ///< step of *BOUNDARY, FIXED; 0: none
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
    prescribe(const InpBlock                  &block,
              const InpLine                   &line,
              const std::vector<unsigned int> &components,
              double                           value,
              std::size_t                      step);
    void
    read_transform(const InpBlock &block);
    void
    find_references();
    bool
    is_kept(const InpBlock &block, std::size_t step);
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
    turn_supports();
    double
    set_axes(const ImportFace &face,
             unsigned int      component,
             ImportCondition  &condition) const;
    void
    find_supports();
    void
    find_affine_supports(unsigned int                     component,
                         const std::vector<unsigned int> &faces);
    void
    find_points();
    void
    find_edges(unsigned int                           body,
               std::array<std::set<unsigned int>, 3> &of_edges);
    using EdgesByValues = std::map<std::array<std::string, 3>,
                                   std::vector<std::array<unsigned int, 2>>>;
    void
    add_lines(unsigned int body, const EdgesByValues &alike);
    std::string
    values_text(unsigned int                     component,
                const std::vector<unsigned int> &nodes) const;
    void
    tell_unsupported() const;
    void
    find_couplings();
    std::vector<unsigned int>
    coupled_faces(const InpBlock &block, const std::string &name) const;
    void
    add_motion(const std::vector<unsigned int> &faces,
               const std::string               &name,
               const std::array<bool, 3>       &follows,
               const Reference                 &reference,
               const dealii::Point<3>          &at,
               const std::string               &what);
    void
    add_rigid_part(const std::vector<unsigned int> &faces,
                   const std::string               &name,
                   const Reference                 &reference,
                   const dealii::Point<3>          &at);
    void
    add_distributed(const std::vector<unsigned int> &faces,
                    const std::string               &name,
                    const Reference                 &reference,
                    const dealii::Point<3>          &at,
                    const std::string               &what);
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
    /// By node: three components along the axes of the scene, then three along
    /// those of *TRANSFORM. Those of the latter that lie in axes of the scene
    /// are both.
    std::array<std::map<unsigned int, Supported>, 6> supported;
    std::array<std::set<unsigned int>, 6> covered; ///< by what is found
    std::map<unsigned int, std::array<bool, 3>>
      scene_axes; ///< local components that are components of the scene, too
    std::map<unsigned int, LocalSystem>               local_axes;
    std::map<unsigned int, Reference>                 references; ///< by node
    std::vector<std::vector<std::string>>             held_at;    ///< by body
    std::array<std::map<unsigned int, NodalForce>, 3> nodal_forces;
    std::map<std::string, FaceLoad>                   face_loads;
    std::map<std::string, BodyForce>                  body_forces;
    std::map<unsigned int, double>                    initial;
    std::map<unsigned int, std::vector<ImportChange>> temperatures;
    std::vector<ImportCondition>                      conditions;
  };
} // namespace mortise
