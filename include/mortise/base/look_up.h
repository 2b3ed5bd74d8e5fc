// Look-up of data of other ranks by key: owners and askers meet at a rank
// determined by the key.
#pragma once

#include <deal.II/base/mpi.h>

#include <boost/serialization/array.hpp>
#include <boost/serialization/map.hpp>
#include <boost/serialization/set.hpp>
#include <boost/serialization/utility.hpp>
#include <boost/serialization/vector.hpp>

#include <map>
#include <set>

namespace mortise
{
  template <typename Key, typename Value>
  struct LookUpMessage
  {
    std::set<Key>        asked;
    std::map<Key, Value> known;

    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int /*version*/)
    {
      archive &asked &known;
    }
  };

  /// The values of the keys @p asked, each of which is among @p known of at
  /// least one rank; all who know a key say the same. @p meeting_rank(key): the
  /// same on all ranks, keys spread evenly. Messages go only to the ranks where
  /// something is to meet. Collective.
  template <typename Key, typename Value, typename MeetingRank>
  std::map<Key, Value>
  look_up(const std::set<Key>        &asked,
          const std::map<Key, Value> &known,
          const MeetingRank          &meeting_rank,
          const MPI_Comm              comm)
  {
    using dealii::Utilities::MPI::some_to_some;
    std::map<unsigned int, LookUpMessage<Key, Value>> messages;
    for (const Key &key : asked)
      messages[meeting_rank(key)].asked.insert(key);
    for (const auto &entry : known)
      messages[meeting_rank(entry.first)].known.insert(entry);
    const auto received = some_to_some(comm, messages);

    std::map<Key, Value> met, result;
    for (const auto &from_rank : received)
      met.insert(from_rank.second.known.begin(), from_rank.second.known.end());
    std::map<unsigned int, std::map<Key, Value>> answers;
    for (const auto &[rank, message] : received)
      for (const Key &key : message.asked)
        answers[rank].emplace(key, met.at(key));
    for (const auto &from_rank : some_to_some(comm, answers))
      result.insert(from_rank.second.begin(), from_rank.second.end());
    return result;
  }
} // namespace mortise
