// Bodies of a deck, and their faces.
#pragma once

#include <mortise/body/mesh/inp_deck.h>

#include <array>
#include <map>
#include <string>
#include <vector>

#include "import_remarks.h"

namespace mortise
{
  struct ImportFace
  {
    InpSide                   side;
    unsigned int              body;
    std::vector<unsigned int> nodes; ///< see InpDeck::nodes_of()
    unsigned int              n_vertices;
    std::vector<unsigned int> conditions; ///< of ImportConditions, ascending
    std::string               boundary;   ///< empty: in none
  };

  struct ImportBody
  {
    std::string               name;
    const InpBlock           *section;
    std::vector<unsigned int> elements; ///< ascending
    std::vector<unsigned int> nodes;    ///< ascending
  };

  /// The vertices of a side, ascending.
  using SideKey = std::vector<unsigned int>;

  /// Faces at which two bodies share nodes.
  struct ImportShared
  {
    std::array<unsigned int, 2> faces;
    const InpBlock             *cut; ///< *PRE-TENSION SECTION; or nullptr
  };

  struct ImportBodies
  {
    ImportBodies(const InpDeck &deck, ImportRemarks &remarks);

    /// Faces of only one element of a body that are sides among @p sides.
    std::vector<unsigned int>
    faces_of(const std::vector<InpSide> &sides) const;

    /// The outward normal, of length 1, or 0 where a face has no area.
    dealii::Tensor<1, 3>
    normal_of(const ImportFace &face) const;

    const InpDeck            &deck;
    std::vector<ImportBody>   bodies;
    std::vector<ImportFace>   faces; ///< those of only one element of a body
    std::vector<ImportShared> shared;
    /// Bodies of each node.
    std::vector<std::vector<unsigned int>> bodies_of_node;

  private:
    std::vector<const InpBlock *>
    sections(ImportRemarks &remarks) const;
    void
    find_cuts();
    void
    find_bodies(const std::vector<const InpBlock *> &section_of);
    void
    name_bodies();
    void
    find_faces();

    SideKey
    key_of(const InpSide &side) const;

    std::map<std::array<unsigned int, 2>, unsigned int> place; ///< of a side
    std::map<SideKey, const InpBlock *> cuts;   ///< faces that part bodies
    std::vector<bool>                   is_cut; ///< by node
  };

  /// A name that a scene may have, of one that may be anything; never one of
  /// @p others, whatever the case of its letters.
  std::string
  scene_name(const std::string &name, const std::vector<std::string> &others);
} // namespace mortise
