// Scenes of axis-parallel boxes, drawn at random, that meet by one law wherever
// two of them share an area, with a linear displacement that every mesh holds
// exactly.
#pragma once

#include <mortise/material/material.h>

#include <algorithm>
#include <array>
#include <random>

#include "scenes.h"

namespace mortise::testing
{
  /// A box of a drawn scene.
  struct DrawnBox
  {
    std::string             name;
    std::array<double, 6>   extent; ///< x0, y0, z0, x1, y1, z1
    std::array<unsigned, 3> cells{{1, 1, 1}};
    unsigned int            degree     = 1;
    bool                    tetrahedra = false;
    double                  young = 900., poisson = 0.25;
    /// By face (xmin, xmax, ymin, ...): one bit for each prescribed component.
    std::array<unsigned int, 6> prescribed{};
  };

  /// Face @p f, xmin, xmax, ymin, ..., of box @p b.
  struct DrawnSide
  {
    unsigned int b, f;
  };

  struct DrawnTie
  {
    std::string name;
    DrawnSide   slave, master;
  };

  struct DrawnScene
  {
    std::vector<DrawnBox> boxes;
    std::vector<DrawnTie> ties;
    double                G[3][3]; ///< u = G x
    std::string           law        = "tie";
    std::string           multiplier = "standard";

    std::string
    text() const;
  };

  inline const char *
  face_name(const unsigned int f)
  {
    static const char *const names[] = {
      "xmin", "xmax", "ymin", "ymax", "zmin", "zmax"};
    return names[f];
  }

  /// The rectangle that faces @p f of @p a and @p g of @p b share, as lower and upper corner in the
  /// two directions along them; empty if they share no area.
  inline std::vector<double>
  shared_rectangle(const DrawnBox    &a,
                   const unsigned int f,
                   const DrawnBox    &b,
                   const unsigned int g)
  {
    const unsigned int d = f / 2;
    if (g / 2 != d || f % 2 == g % 2 ||
        std::fabs(a.extent[d + 3 * (f % 2)] - b.extent[d + 3 * (g % 2)]) >
          1e-12)
      return {};
    std::vector<double> rectangle;
    for (unsigned int e = 0; e < 3; ++e)
      if (e != d)
        {
          rectangle.push_back(std::max(a.extent[e], b.extent[e]));
          rectangle.push_back(std::min(a.extent[e + 3], b.extent[e + 3]));
          if (rectangle.back() - rectangle[rectangle.size() - 2] < 1e-9)
            return {};
        }
    return rectangle;
  }

  /// Traction of the linear field on face @p f of a body of the material of @p box.
  inline std::array<double, 3>
  drawn_traction(const DrawnScene  &scene,
                 const DrawnBox    &box,
                 const unsigned int f)
  {
    dealii::Tensor<2, 3> gradient;
    for (unsigned int c = 0; c < 3; ++c)
      for (unsigned int d = 0; d < 3; ++d)
        gradient[c][d] = scene.G[c][d];
    const auto stress =
      Material(LinearElastic{box.young, box.poisson}).stress(gradient);
    std::array<double, 3> traction;
    for (unsigned int c = 0; c < 3; ++c)
      traction[c] = (f % 2 ? 1. : -1.) * stress[c][f / 2];
    return traction;
  }

  /// The stiffness of springs, per area.
  constexpr double drawn_spring = 700.;

  /// Does nobody meet face @p f of box @p b?
  inline bool
  is_outside(const DrawnScene  &scene,
             const unsigned int b,
             const unsigned int f)
  {
    return std::none_of(scene.ties.begin(),
                        scene.ties.end(),
                        [&](const DrawnTie &tie) {
                          return (tie.slave.b == b && tie.slave.f == f) ||
                                 (tie.master.b == b && tie.master.f == f);
                        });
  }

  /// The load that face @p f of box @p b needs: the traction of its own field
  /// where nobody is tied to it, nothing where a master is, and where it is
  /// master the difference to the field of its slave. But for ties this is so
  /// for normal tractions alone, and tangential ones are all loads. Jumps of
  /// the load lie on lines of the mesh wherever the load is not zero
  /// everywhere.
  inline std::string
  drawn_load(const DrawnScene  &scene,
             const unsigned int b,
             const unsigned int f)
  {
    const DrawnBox &box  = scene.boxes[b];
    const auto      own  = drawn_traction(scene, box, f);
    double          area = 1.;
    unsigned int    along[2], n = 0;
    for (unsigned int e = 0; e < 3; ++e)
      if (e != f / 2)
        {
          area *= box.extent[e + 3] - box.extent[e];
          along[n++] = e;
        }
    std::array<std::string, 3> sum     = {{"", "", ""}};
    double                     covered = 0.;
    bool                       loaded  = false;
    for (const DrawnTie &tie : scene.ties)
      for (const bool is_slave : {true, false})
        {
          const DrawnSide &side  = is_slave ? tie.slave : tie.master,
                          &other = is_slave ? tie.master : tie.slave;
          if (side.b != b || side.f != f)
            continue;
          const auto r =
            shared_rectangle(box, f, scene.boxes[other.b], other.f);
          covered += (r[1] - r[0]) * (r[3] - r[2]) / area;
          const std::string inside =
            "if(" + std::string(1, "xyz"[along[0]]) + " > " + number(r[0]) +
            " && " + "xyz"[along[0]] + " < " + number(r[1]) + " && " +
            "xyz"[along[1]] + " > " + number(r[2]) + " && " + "xyz"[along[1]] +
            " < " + number(r[3]) + ", 1, 0)";
          const auto of_slave =
            drawn_traction(scene, scene.boxes[tie.slave.b], f);
          for (unsigned int c = 0; c < 3; ++c)
            {
              const bool   passes = scene.law == "tie" || c == f / 2;
              const double value =
                passes ? (is_slave ? -own[c] : -of_slave[c]) : 0.;
              loaded =
                loaded || std::fabs(value + own[c]) > 1e-13 * std::fabs(own[c]);
              sum[c] += " + " + number(value) + "*" + inside;
            }
        }
    if (std::fabs(covered - 1.) < 1e-12 && !loaded)
      return "";
    std::string text;
    for (unsigned int c = 0; c < 3; ++c)
      text += (c ? "; " : "") + number(own[c]) + sum[c];
    return text;
  }

  inline std::string
  DrawnScene::text() const
  {
    const auto list = [](const auto &values, const auto &name) {
      std::string result;
      for (unsigned int i = 0; i < values.size(); ++i)
        result += (i ? ", " : "") + name(values[i], i);
      return result;
    };
    const auto plain = [](const auto value, const unsigned int) {
      return number(value);
    };
    std::string result =
      "set Bodies = " +
      list(boxes, [](const DrawnBox &box, unsigned int) { return box.name; }) +
      "\nset Interfaces = " +
      list(ties, [](const DrawnTie &tie, unsigned int) { return tie.name; }) +
      "\n";
    for (unsigned int b = 0; b < boxes.size(); ++b)
      {
        const DrawnBox &box = boxes[b];
        result +=
          "subsection Body " + box.name +
          "\n  set Degree = " + std::to_string(box.degree) +
          "\n  subsection Mesh\n    set Source = box\n    set Extent = " +
          list(box.extent, plain) +
          "\n    set Subdivisions = " + list(box.cells, plain) +
          (box.tetrahedra ? "\n    set Cells = tetrahedra" : "") +
          "\n  end\n  subsection Material\n    set Young modulus = " +
          number(box.young) +
          "\n    set Poisson ratio = " + number(box.poisson) + "\n  end\n";
        for (unsigned int f = 0; f < 6; ++f)
          {
            std::string what;
            if (box.prescribed[f] != 0)
              for (unsigned int c = 0; c < 3; ++c)
                what += std::string(c ? ", " : "    set Displacement = ") +
                        (box.prescribed[f] & (1u << c) ? "exact" : "-");
            if (box.prescribed[f] != 7)
              if (const std::string load = drawn_load(*this, b, f);
                  !load.empty())
                what += (what.empty() ? "" : "\n") +
                        std::string("    set Traction = ") + load;
            if (!what.empty())
              result += "  subsection Boundary " + std::string(face_name(f)) +
                        "\n" + what + "\n  end\n";
          }
        result += "end\n";
      }
    for (const DrawnTie &tie : ties)
      {
        const auto side = [&](const DrawnSide &s) {
          return boxes[s.b].name + ": " + face_name(s.f);
        };
        result += "subsection Interface " + tie.name +
                  "\n  set Slave = " + side(tie.slave) +
                  "\n  set Master = " + side(tie.master) +
                  "\n  set Law = " + law + "\n  set Multiplier = " + multiplier;
        if (law == "spring") // nothing opens under the normal traction
          result += "\n  set Normal stiffness = " + number(drawn_spring) +
                    "\n  set Tangential stiffness = " + number(drawn_spring) +
                    "\n  set Offset = " +
                    number((tie.slave.f % 2 ? 1. : -1.) *
                           drawn_traction(*this,
                                          boxes[tie.slave.b],
                                          tie.slave.f)[tie.slave.f / 2] /
                           drawn_spring);
        result += "\nend\n";
      }
    std::string exact;
    for (unsigned int c = 0; c < 3; ++c)
      for (unsigned int d = 0; d < 3; ++d)
        exact += (d ? " + " : c ? "; " : "") + number(G[c][d]) + "*" + "xyz"[d];
    return result + "subsection Exact solution\n  set Displacement = " + exact +
           "\nend\nsubsection Output\n  set Directory = unused\n  set Fields =\n"
           "end\nsubsection Solver\n  set Tolerance = 1e-13\nend\n";
  }

  /// Let bodies meet by @p law with @p multiplier. Where they slide, the field
  /// has no shear, which would have to pass, and bodies are held where they can
  /// be: most would float.
  inline void
  set_law(const std::string &law,
          const std::string &multiplier,
          DrawnScene        &scene)
  {
    scene.law        = law;
    scene.multiplier = multiplier;
    if (law == "tie")
      return;
    for (unsigned int c = 0; c < 3; ++c)
      for (unsigned int d = 0; d < c; ++d)
        scene.G[d][c] = -scene.G[c][d];
    for (unsigned int b = 0; b < scene.boxes.size() && law == "slide"; ++b)
      for (unsigned int f = 0; f < 6; ++f)
        if (is_outside(scene, b, f))
          {
            scene.boxes[b].prescribed[f] = 7;
            break;
          }
  }

  /// Draws scenes; the same ones for the same seed on every machine.
  class BoxDraws
  {
  public:
    explicit BoxDraws(const unsigned int seed)
      : engine(seed)
    {}

    /// A whole number from @p low to @p high.
    unsigned int
    draw(const unsigned int low, const unsigned int high)
    {
      return low + engine() % (high - low + 1);
    }

    bool
    with_chance(const unsigned int percent)
    {
      return draw(1, 100) <= percent;
    }

    /// @p n cubes along each edge of a larger cube, some of them missing.
    DrawnScene
    cubes(const unsigned int n, const unsigned int max_degree)
    {
      DrawnScene scene;
      do
        {
          scene.boxes.clear();
          const unsigned int percent = draw(50, 100);
          for (unsigned int i = 0; i < n * n * n; ++i)
            if (with_chance(percent))
              {
                const unsigned int at[] = {i / (n * n), i / n % n, i % n};
                DrawnBox           box;
                box.name = "c";
                for (unsigned int d = 0; d < 3; ++d)
                  {
                    box.name += std::to_string(at[d]);
                    box.extent[d]     = at[d];
                    box.extent[d + 3] = at[d] + 1.;
                  }
                scene.boxes.push_back(box);
              }
          find_ties(scene);
        }
      while (!is_connected(scene));
      finish(scene, max_degree, true);
      return scene;
    }

    /// Layers of bricks, cut at random places: faces meet several others, and
    /// lines of meshes meet nowhere.
    DrawnScene
    bricks(const unsigned int max_boxes, const unsigned int max_degree)
    {
      DrawnScene scene;
      do
        {
          scene.boxes.clear();
          const unsigned int n_layers = draw(2, 3);
          for (unsigned int layer = 0; layer < n_layers; ++layer)
            {
              const auto x = cuts(), y = with_chance(40) ?
                                           cuts() :
                                           std::vector<double>{0., 1.};
              for (unsigned int i = 0; i + 1 < x.size(); ++i)
                for (unsigned int j = 0; j + 1 < y.size(); ++j)
                  {
                    DrawnBox box;
                    box.name   = "b" + std::to_string(scene.boxes.size());
                    box.extent = {{x[i],
                                   y[j],
                                   0.5 * layer,
                                   x[i + 1],
                                   y[j + 1],
                                   0.5 * layer + 0.5}};
                    scene.boxes.push_back(box);
                  }
            }
          find_ties(scene);
        }
      while (scene.boxes.size() > max_boxes || !is_connected(scene));
      finish(scene, max_degree, false);
      return scene;
    }

    /// A block whose mesh has lines wherever smaller ones on top of it end.
    DrawnScene
    tower(const unsigned int max_degree)
    {
      DrawnScene scene;
      DrawnBox   base;
      base.name   = "base";
      base.extent = {{0., 0., 0., 1., 1., 0.5}};
      scene.boxes.push_back(base);
      const unsigned int n = draw(2, 4);
      for (unsigned int i = 0; i < n; ++i)
        {
          DrawnBox box;
          box.name           = "top" + std::to_string(i);
          const double width = 1. / n, low = draw(0, 1) * 0.5;
          box.extent = {{i * width, low, 0.5, (i + 1) * width, low + 0.5, 1.}};
          if (with_chance(30))
            box.extent[4] = 1.;
          scene.boxes.push_back(box);
        }
      find_ties(scene);
      finish(scene, max_degree, true);
      for (DrawnBox &box : scene.boxes)
        if (box.extent[4] - box.extent[1] == 1.)
          box.cells[1] = 2 * draw(1, 2);
      DrawnBox &first = scene.boxes[0];
      first.cells[0]  = n * draw(1, 2);
      return scene;
    }

    std::mt19937 engine;

  private:
    /// 0, ..., 1 with up to two places between them.
    std::vector<double>
    cuts()
    {
      std::vector<double> result = {0.};
      const unsigned int  n      = draw(0, 2);
      if (n == 1)
        result.push_back(draw(2, 8) / 10.);
      else if (n == 2)
        {
          result.push_back(draw(2, 4) / 10.);
          result.push_back(draw(6, 8) / 10.);
        }
      result.push_back(1.);
      return result;
    }

    void
    find_ties(DrawnScene &scene)
    {
      scene.ties.clear();
      for (unsigned int a = 0; a < scene.boxes.size(); ++a)
        for (unsigned int b = a + 1; b < scene.boxes.size(); ++b)
          for (unsigned int f = 0; f < 6; ++f)
            if (!shared_rectangle(scene.boxes[a], f, scene.boxes[b], f ^ 1u)
                   .empty())
              {
                DrawnTie tie{"i" + std::to_string(scene.ties.size()),
                             {a, f},
                             {b, f ^ 1u}};
                if (with_chance(50))
                  std::swap(tie.slave, tie.master);
                scene.ties.push_back(tie);
              }
      shuffle(scene.ties);
    }

    template <typename T>
    void
    shuffle(std::vector<T> &list)
    {
      for (unsigned int i = list.size(); i > 1; --i)
        std::swap(list[i - 1], list[draw(0, i - 1)]);
    }

    static bool
    is_connected(const DrawnScene &scene)
    {
      std::vector<bool> reached(scene.boxes.size(), false);
      if (reached.size() < 2)
        return false;
      reached[0] = true;
      for (unsigned int sweep = 0; sweep < reached.size(); ++sweep)
        for (const DrawnTie &tie : scene.ties)
          if (reached[tie.slave.b] || reached[tie.master.b])
            reached[tie.slave.b] = reached[tie.master.b] = true;
      return std::all_of(reached.begin(), reached.end(), [](const bool r) {
        return r;
      });
    }

    /// Meshes, degrees, materials, what is prescribed, and the field.
    void
    finish(DrawnScene        &scene,
           const unsigned int max_degree,
           const bool         different_materials)
    {
      const bool with_tetrahedra = with_chance(30);
      for (DrawnBox &box : scene.boxes)
        {
          for (unsigned int &n : box.cells)
            n = draw(1, 3);
          box.degree     = draw(1, max_degree);
          box.tetrahedra = with_tetrahedra && with_chance(40);
          if (different_materials && with_chance(40))
            {
              box.young *= std::pow(10., draw(0, 4) - 2.);
              box.poisson = draw(0, 9) / 20.;
            }
        }
      const unsigned int     percent = draw(0, 60);
      std::vector<DrawnSide> outside;
      for (unsigned int b = 0; b < scene.boxes.size(); ++b)
        for (unsigned int f = 0; f < 6; ++f)
          if (is_outside(scene, b, f))
            {
              outside.push_back({b, f});
              if (with_chance(percent))
                scene.boxes[b].prescribed[f] = with_chance(60) ? 7 : draw(1, 6);
            }
      const DrawnSide prescribed = outside[draw(0, outside.size() - 1)];
      scene.boxes[prescribed.b].prescribed[prescribed.f] = 7;
      for (unsigned int c = 0; c < 3; ++c)
        for (unsigned int d = 0; d < 3; ++d)
          scene.G[c][d] = (int(draw(0, 20)) - 10) / 100.;
    }
  };
} // namespace mortise::testing
