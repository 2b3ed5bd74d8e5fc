// Ties and contacts of a deck as interfaces of a scene.
#pragma once

#include <string>
#include <vector>

#include "import_bodies.h"
#include "import_conditions.h"
#include "import_history.h"
#include "import_remarks.h"

namespace mortise
{
  class ImportInterfaces
  {
  public:
    /// Adds the sides to @p conditions.
    ImportInterfaces(ImportBodies      &bodies,
                     ImportConditions  &conditions,
                     const ImportSteps &steps,
                     ImportRemarks     &remarks);

    bool
    any() const
    {
      return !interfaces.empty();
    }

    /// "glue, touch".
    std::string
    names() const;

    /// Sections Interface, once the boundaries have names.
    std::string
    text() const;

  private:
    struct Side
    {
      unsigned int              condition;
      std::vector<unsigned int> bodies;
    };
    struct Interface
    {
      std::string  name;
      unsigned int slave_body, master_body, slave, master; ///< conditions
      std::string  lines;                                  ///< of its section
    };

    std::string
    unused_name(const std::string &name) const;
    void
    tie_shared_faces();
    void
    add_pair(const std::string &name,
             const std::string &slave,
             const std::string &master,
             const InpBlock    &block,
             const InpLine     &line,
             const std::string &lines);
    std::string
    contact_lines(const InpBlock &block);
    std::string
    clearance(const std::string &slave, const std::string &master) const;
    Side
    side(const std::string &surface, const std::string &key);
    bool
    are_near(unsigned int a, unsigned int b) const;

    ImportBodies                           &bodies;
    ImportConditions                       &conditions;
    const ImportSteps                      &steps;
    ImportRemarks                          &remarks;
    std::vector<Interface>                  interfaces;
    std::map<std::string, const InpBlock *> frictions, behaviours, interactions;
    std::vector<const InpBlock *>           clearances;
  };
} // namespace mortise
