#include <mortise/body/mesh/mesh_findings.h>

#include <algorithm>
#include <sstream>

namespace mortise
{
  std::string
  place_name(const dealii::Point<3> &x)
  {
    std::ostringstream text;
    text << "(" << x[0] << ", " << x[1] << ", " << x[2] << ")";
    return text.str();
  }

  void
  MeshFinding::at(const std::string &who, const dealii::Point<3> &x)
  {
    constexpr std::size_t most = 3;
    if (named.insert(who).second && ++count <= most)
      places.push_back(who + " at " + place_name(x));
  }

  std::string
  MeshFinding::text() const
  {
    std::string result = what;
    if (count > 0)
      result += ": " + std::to_string(count);
    for (const std::string &place : places)
      result += ", " + place;
    return result + (count > places.size() ? ", ..." : "") +
           (remedy.empty() ? "" : "; " + remedy);
  }

  MeshFinding &
  MeshFindings::find(const bool         is_error,
                     const std::string &what,
                     const std::string &remedy)
  {
    const auto known =
      std::find_if(findings.begin(), findings.end(), [&](const MeshFinding &f) {
        return f.what == what;
      });
    if (known != findings.end())
      return *known;
    findings.push_back({is_error, what, remedy, 0, {}, {}});
    return findings.back();
  }

  MeshFinding &
  MeshFindings::error(const std::string &what, const std::string &remedy)
  {
    return find(true, what, remedy);
  }

  MeshFinding &
  MeshFindings::warning(const std::string &what, const std::string &remedy)
  {
    return find(false, what, remedy);
  }

  bool
  MeshFindings::has_errors() const
  {
    return std::any_of(findings.begin(),
                       findings.end(),
                       [](const MeshFinding &f) { return f.is_error; });
  }

  std::vector<std::string>
  MeshFindings::lines() const
  {
    std::vector<std::string> result;
    for (const MeshFinding &finding : findings)
      if (finding.is_error)
        result.push_back("  error: " + finding.text());
    for (const std::string &text : warnings())
      result.push_back("  warning: " + text);
    return result;
  }

  std::vector<std::string>
  MeshFindings::warnings() const
  {
    std::vector<std::string> result;
    for (const MeshFinding &finding : findings)
      if (!finding.is_error)
        result.push_back(finding.text());
    return result;
  }
} // namespace mortise
