// Input files of Abaqus and CalculiX (.inp) as data: nodes, elements, sets and
// surfaces, with parts and instances resolved, and all other keywords as they
// stand.
#pragma once

#include <deal.II/base/point.h>

#include <array>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace mortise
{
  /// Throws InputError with the file's name before @p what.
  using FileError = std::function<void(const std::string &what)>;

  /// Text in capitals: names and keywords of these files have no case.
  std::string
  upper(std::string text);

  struct InpElement
  {
    std::string               type;                          ///< in capitals
    unsigned int              dimension = 0, n_vertices = 0; ///< see InpType
    std::vector<unsigned int> nodes; ///< indices; empty: neither solid nor flat
    long                      tag = 0;
  };

  struct InpSide
  {
    unsigned int element; ///< index
    unsigned int face;    ///< of InpShape::faces: S1 is 0
  };

  /// A line of data: its words between commas.
  struct InpLine
  {
    std::vector<std::string> words;
    std::string              place; ///< "line 12", "line 3 of 'mesh.inc'"
  };

  /// A keyword with its options (names in capitals) and lines.
  struct InpBlock
  {
    std::string                        keyword; ///< "*SOLID SECTION"
    std::map<std::string, std::string> options;
    std::string                        instance; ///< whose part it is in
    std::string                        place;
    std::vector<InpLine>               lines;

    /// The value of an option, empty if there is none.
    std::string
    option(const std::string &name) const;

    bool
    has(const std::string &name) const
    {
      return options.count(name) > 0;
    }
  };

  /// Names are in capitals; those within instances begin with "INSTANCE.".
  struct InpDeck
  {
    template <typename T>
    using Named = std::map<std::string, T>;

    std::vector<dealii::Point<3>> nodes;
    std::vector<std::size_t>      node_tags; ///< their numbers in the file
    std::vector<InpElement>       elements;

    Named<std::set<unsigned int>> node_sets, element_sets; ///< of indices
    Named<std::vector<InpSide>>   surfaces;
    Named<std::set<unsigned int>> node_surfaces; ///< TYPE=NODE
    Named<std::string>            names;         ///< as first written
    std::vector<InpBlock>         blocks; ///< all other keywords, in order
    /// Elements that are neither solids nor flat, surfaces of others than
    /// solids: their places, and what they are.
    std::vector<std::array<std::string, 2>> passed_over;

    /// Indices by the numbers of the file, and rotations, by instance; "": of
    /// what is in none.
    Named<std::map<long, unsigned int>> node_places, element_places;
    Named<dealii::Tensor<2, 3>>         rotations;

    /// What @p word means within @p instance: the number of a node or an
    /// element, or the name of a set; also "INSTANCE.12" and "INSTANCE.SET".
    /// nullptr: nothing.
    const std::set<unsigned int> *
    find_set(const Named<std::set<unsigned int>> &sets,
             const std::string                   &word,
             const std::string                   &instance) const;
    std::set<unsigned int>
    find_nodes(const std::string &word, const std::string &instance) const;
    std::set<unsigned int>
    find_elements(const std::string &word, const std::string &instance) const;

    /// The key of a surface in surfaces or node_surfaces, empty if there is
    /// none.
    std::string
    find_surface(const std::string &word, const std::string &instance) const;

    /// Sides of solid elements all of whose vertices are among @p of_set.
    std::vector<InpSide>
    sides_of(const std::set<unsigned int> &of_set) const;

    /// Nodes of a side, vertices first, then those in the middles of edges.
    std::vector<unsigned int>
    nodes_of(const InpSide &side) const;
  };

  /// Read @p file and what it includes. @p fail is told what is wrong, and in
  /// which line.
  InpDeck
  read_inp_deck(const std::string &file, const FileError &fail);

  /// The number that @p word is, also with the exponent d of Fortran, or what
  /// is told of it to @p fail.
  double
  inp_number(const std::string &word, const FileError &fail);
} // namespace mortise
