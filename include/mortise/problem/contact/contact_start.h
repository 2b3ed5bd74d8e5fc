// First guess of the contact by nested iteration over the degree: solutions
// with lower degrees are cheap, and the number of sets grows with the nodes
// between the first guess and the edge of the contact.
#pragma once

#include <mortise/contact/contact_records.h>
#include <mortise/problem/input/run_context.h>
#include <mortise/problem/scene/scene_spaces.h>

#include <optional>

namespace mortise
{
  /// For the loads at @p time, from degree one (bodies in mixed form: two) up
  /// to half of what the parameters say. Nothing without contact, for few
  /// nodes, with the lowest degrees, or if contact is lost, which the scene
  /// itself reports. Changes the spaces of @p bodies. Collective.
  std::optional<ContactRecords>
  contact_start(const RunContext &run, double time, Bodies &bodies);
} // namespace mortise
