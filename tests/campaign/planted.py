#!/usr/bin/env python3
"""Plants defects in a copy of the sources, to see that campaign.py finds them: planted.py TREE

One build has all of them; MORTISE_PLANTED=A, ... chooses one at run time. README.md has what was found, and how soon.
"""
import os
import sys

HEADER = """#pragma once
#include <cstdlib>
inline bool planted(const char which)
{
  static const char *const chosen = std::getenv("MORTISE_PLANTED");
  return chosen != nullptr && *chosen == which;
}
"""
# letter, file, what stands there, and what is to stand there
DEFECTS = [
    # nodes of elements are not checked
    ("A", "source/body/mesh/msh_tags.h", "if (found == positions.end() || found->first != tag)",
     "if (planted('A') && found == positions.end()) return tag; if (found == positions.end() || found->first != tag)"),
    # sizes in a mesh file are not checked before memory is taken
    ("B", "source/body/mesh/msh_reader.cc", 'in.fits(n, 28, "nodes");',
     "if (planted('B')) model.nodes.resize(n), model.nodes.clear(); else in.fits(n, 28, \"nodes\");"),
    # a section without its end is read for ever
    ("C", "source/body/mesh/msh_scanner.h", "if (end == std::string::npos)",
     "while (planted('C') && end == std::string::npos) (void)content.size(); if (end == std::string::npos)"),
    # degrees by region are not checked
    ("D", "source/problem/input/parameter_entry.cc", "return least <= value && value <= most;",
     "return least <= value && (value <= most || planted('D'));"),
    # springs have the wrong sign in nonlinear scenes
    ("E", "source/problem/nonlinear_step.cc", "r.multiplier.sadd(-1., 1., load->rhs.multiplier);",
     "r.multiplier.sadd(-1., 1., load->rhs.multiplier); if (planted('E')) { system.subtract_spring_opening(r.multiplier, x.multiplier); "
     "system.subtract_spring_opening(r.multiplier, x.multiplier); }"),
    # shear moduli of orthotropic bodies in the wrong order
    ("F", "source/material/orthotropic.cc", "material.shear_moduli[(i + 1) % 3]", "material.shear_moduli[(i + (planted('F') ? 2 : 1)) % 3]"),
    # checksums of values are not compared
    ("G", "source/output/checkpoint_file.cc", "if (checksum(start, size) != expected)", "if (!planted('G') && checksum(start, size) != expected)"),
    # what could not be written stays
    ("I", "source/output/whole_file.cc", "if (!unfinished.empty())\n          unlink", "if (!unfinished.empty() && !planted('I'))\n          unlink"),
    # what points remember is lost
    ("J", "source/problem/nonlinear_step.cc", "histories.push_back(of_body.history);",
     "{ histories.push_back(of_body.history); if (planted('J')) for (auto &of_cell : histories.back()) for (double &value : of_cell) value = 0.; }"),
    # a message as long as what is allowed
    ("L", "source/problem/input/parameter_file.cc", "const std::string nearest = nearest_name(got, allowed);",
     "const std::string nearest = nearest_name(got, allowed); if (planted('L')) { std::string all; for (const std::string &name : allowed) "
     "all += name + \"\\n\\n\\n\"; return all; }"),
    # an exception that nobody expects
    ("M", "source/problem/input/parameter_entry.cc", "if (!Patterns::Integer(0).match(part))", "if (!planted('M') && !Patterns::Integer(0).match(part))"),
]


def main(tree):
    header = os.path.join(tree, "include", "mortise", "base", "planted.h")
    with open(header, "w") as file:
        file.write(HEADER)
    for letter, name, old, new in DEFECTS:
        with open(os.path.join(tree, name)) as file:
            text = file.read()
        if old not in text:
            sys.exit("%s: %s has no longer: %s" % (letter, name, old))
        text = text.replace(old, new)
        if "planted.h" not in text:
            first = text.index("#include") if "#include" in text else 0
            text = text[:first] + "#include <mortise/base/planted.h>\n" + text[first:]
        with open(os.path.join(tree, name), "w") as file:
            file.write(text)


if __name__ == "__main__":
    main(sys.argv[1])
