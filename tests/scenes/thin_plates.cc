// Proves that what holds thin bodies is told from what leaves them free, where
// sliding interfaces and supports on short edges hold them: plates of a
// hundredth and a thousandth of their length come out right or are refused with
// the motion that is free, hexahedra and tetrahedra; so are short and long
// tubes that slide along each other.
#include "scene.h"
#include "scenes.h"

using namespace mortise;
using namespace mortise::testing;

namespace
{
  constexpr double E = 1000.;

  struct Form
  {
    std::string  cells;
    unsigned int degree;
  };

  std::string
  plate(const std::string &name,
        const std::string &extent,
        const std::string &subdivisions,
        const Form        &form,
        const std::string &boundaries)
  {
    return "subsection Body " + name +
           "\n  set Degree = " + std::to_string(form.degree) +
           "\n  subsection Mesh\n    set Source = box\n    set Extent = " +
           extent + "\n    set Subdivisions = " + subdivisions +
           "\n    set Cells = " + form.cells +
           "\n  end\n  subsection Material\n    set Young modulus = 1000\n"
           "    set Poisson ratio = 0\n  end\n" +
           boundaries + "end\n";
  }

  std::string
  side(const std::string &name, const std::string &what)
  {
    return "  subsection Boundary " + name + "\n    set " + what + "\n  end\n";
  }

  std::string
  sliding(const std::string &bodies,
          const std::string &slave,
          const std::string &master)
  {
    return tied(bodies, slave, master) +
           "subsection Interface glue\n  set Law = slide\nend\n"
           "subsection Solver\n  set Method = direct\nend\n";
  }

  void
  check_at(const std::string         &what,
           const std::string         &text,
           const std::string         &point,
           const std::vector<double> &expected)
  {
    const auto got = run_scene(text, {"Output/Points=at: " + point})
                       .steps.back()
                       .quantities[0]
                       .second;
    double difference = 0., size = 0.;
    for (unsigned int c = 0; c < 3; ++c)
      {
        difference = std::max(difference, std::fabs(got[c] - expected[c]));
        size       = std::max(size, std::fabs(expected[c]));
      }
    verdict(what, difference / size, 1e-6);
  }

  std::string
  clamped()
  {
    return side("xmin", "Displacement = 0, 0, 0");
  }

  /// One on the other, both clamped at an edge: the upper one is pulled, or
  /// both bend, each about its middle.
  void
  check_clamped(const std::string &what, const double h, const Form &form)
  {
    const std::string H     = number(h);
    const auto        scene = [&](const std::string &of_lower,
                           const std::string &of_upper) {
      return sliding("lower, upper", "lower: zmax", "upper: zmin") +
             plate("lower",
                   "0, 0, 0, 1, 1, " + H,
                   "3, 3, 1",
                   form,
                   clamped() + of_lower) +
             plate("upper",
                   "0, 0, " + H + ", 1, 1, " + number(2. * h),
                   "4, 2, 1",
                   form,
                   clamped() + of_upper);
    };
    check_at(what + ", pulled",
             scene("", side("xmax", "Traction = 1; 0; 0")),
             "upper: 1, 0.5, " + number(1.5 * h),
             {1. / E, 0., 0.});
    if (form.degree > 1)
      check_at(
        what + ", bent",
        scene(side("xmax", "Traction = z - " + number(0.5 * h) + "; 0; 0"),
              side("xmax", "Traction = z - " + number(1.5 * h) + "; 0; 0")),
        "upper: 1, 0.5, " + number(1.5 * h),
        {0., 0., -0.5 / E});
  }

  /// In line: the rim of one alone keeps the other from turning about its held
  /// edge.
  void
  check_rims(const std::string &what, const double h, const Form &form)
  {
    check_at(
      what + ", in line",
      sliding("left, right", "left: xmax", "right: xmin") +
        plate(
          "left", "-1, 0, 0, 0, 1, " + number(h), "3, 3, 1", form, clamped()) +
        plate("right",
              "0, 0, 0, 1, 1, " + number(h),
              "4, 2, 1",
              form,
              side("xmax",
                   "Displacement = -, 0, 0\n    set Traction = -1; 0; 0")),
      "right: 1, 0.5, " + number(0.5 * h),
      {-2. / E, 0., 0.});
  }

  /// The upper one is held along y only.
  void
  check_free(const std::string &what, const double h, const Form &form)
  {
    check_message(what + ", free along x",
                  sliding("lower, upper", "lower: zmax", "upper: zmin") +
                    plate("lower",
                          "0, 0, 0, 1, 1, " + number(h),
                          "3, 3, 1",
                          form,
                          clamped()) +
                    plate("upper",
                          "0, 0, " + number(h) + ", 1, 1, " + number(2. * h),
                          "4, 2, 1",
                          form,
                          side("ymin", "Displacement = -, 0, -")),
                  {},
                  "can move freely: translation along x.");
  }

  /// A quarter of a tube in another one, held along its axis by nothing.
  void
  check_tubes(const std::string &what, const double length, const Form &form)
  {
    std::string text =
      sliding("inner, outer", "inner: outside", "outer: inside");
    for (const std::string name : {"inner", "outer"})
      text +=
        "subsection Body " + name +
        "\n  set Degree = " + std::to_string(form.degree) +
        "\n  subsection Mesh\n    set Source = cylinder sector\n"
        "    set Extent = " +
        (name == "inner" ? "1, 2, " : "2, 3, ") + number(length) +
        "\n    set Subdivisions = " + (name == "inner" ? "4" : "5") +
        ", 1, 2\n    set Cells = " + form.cells +
        "\n  end\n  subsection Material\n    set Young modulus = 1000\n  end\n" +
        side("xmin", "Displacement = 0, -, -") +
        side("ymin", "Displacement = -, 0, -") +
        (name == "inner" ? "" : side("zmin", "Displacement = -, -, 0")) +
        "end\n";
    check_message(what + ", a tube in another one",
                  text,
                  {},
                  "can move freely: translation along z.");
  }
} // namespace

int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const std::string cells : {"hexahedra", "tetrahedra"})
    for (const unsigned int p : {1, 2, 3})
      {
        const Form        form{cells, p};
        const std::string of = cells + " of degree " + std::to_string(p) + ", ";
        for (const double h : {1e-2, 1e-3})
          {
            const std::string what = of + "thickness " + number(h);
            check_clamped(what, h, form);
            check_rims(what, h, form);
            check_free(what, h, form);
          }
        for (const double length : {0.05, 1., 10.})
          check_tubes(of + "length " + number(length), length, form);
      }
}
