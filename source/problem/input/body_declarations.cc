#include <mortise/problem/input/parameter_schema.h>

#include <sstream>

namespace mortise
{
  namespace
  {
    void
    set_degrees_by_region(BodyParameters &body, const ParameterValue &value)
    {
      body.degree_by_region.clear();
      for (const auto &record : value.records(2))
        {
          const unsigned int id     = value.integer(record[0]),
                             degree = value.integer(record[1]);
          if (degree < min_degree || degree > max_degree)
            value.fail("degree " + std::to_string(degree));
          if (!body.degree_by_region.emplace(id, degree).second)
            value.fail(in_quotes(record[0] + ": " + record[1]),
                       "each material id only once");
        }
    }

    /// "a, b; c, d; ..."
    std::vector<std::pair<double, double>>
    pairs(const ParameterValue &value)
    {
      std::vector<std::pair<double, double>> result;
      std::istringstream                     records(value.text);
      for (std::string record; std::getline(records, record, ';');)
        {
          const std::size_t comma = record.find(',');
          if (comma == std::string::npos)
            value.fail(in_quotes(record));
          result.emplace_back(value.number(record.substr(0, comma)),
                              value.number(record.substr(comma + 1)));
        }
      return result;
    }

    void
    set_displacement(BoundaryParameters &boundary, const ParameterValue &value)
    {
      const std::string along_normal = "normal";
      boundary.displacement.reset();
      boundary.normal_displacement.reset();
      if (value.text.compare(0, along_normal.size(), along_normal) != 0)
        return value.read(boundary.displacement);
      const auto record = value.records(2);
      if (record.size() != 1 || record[0][0] != along_normal)
        value.fail(in_quotes(value.text));
      boundary.normal_displacement = record[0][1];
    }

    void
    set_supports(std::vector<PointSupport> &supports,
                 const ParameterValue      &value)
    {
      supports.clear();
      for (const auto &record : value.records(2))
        {
          PointSupport support{record[0] + ": " + record[1], {}, {}};
          ParameterValue{record[0], value.where, value.allowed}.read(
            support.ends);
          ParameterValue{record[1], value.where, value.allowed}.read(
            support.displacement);
          if (support.ends.size() != 3 && support.ends.size() != 6)
            value.fail(in_quotes(record[0]));
          supports.push_back(support);
        }
    }

    void
    declare_boundary(const ParameterSection &section,
                     BoundaryParameters     &boundary)
    {
      section.add(
        "Pressure",
        boundary.pressure,
        {"Pressure, acting against the outward normal []. Empty: none.",
         "force per area"},
        {"an expression in x, y, z, t; or exact"});
      section.add(
        "Pressure follows",
        "auto",
        "Does Pressure act on the deformed face, along its normal and per its area? auto: in bodies with finite strains.",
        Allowed::one_of({"auto", "true", "false"}),
        [&boundary](const ParameterValue &value) {
          boundary.pressure_follows.reset();
          if (value.text != "auto")
            boundary.pressure_follows = value.text == "true";
        });
      section.add("Traction",
                  boundary.traction,
                  {"Force on the surface, added to Pressure []. Empty: none.",
                   "force per area"},
                  {"three expressions \"tx; ty; tz\"; or exact"});
      section.add(
        "Force",
        boundary.force,
        {"Total force on the boundary, spread evenly over its area and added to the others []. Empty: none.",
         "force"},
        {"three expressions \"Fx; Fy; Fz\" in t"});
      section.add(
        "Reference point",
        boundary.reference_point,
        {"Point on which Force acts and about which Rotation turns, in the boundary or away from it []. A Force there is "
         "spread over the boundary together with its moment. Empty: the centroid of the area.",
         "length"},
        {"3 numbers"});
      section.add(
        "Coupling",
        boundary.coupling,
        "How the boundary is coupled to its Reference point. distributing: a Force there is spread over the boundary, which "
        "deforms. rigid: the boundary moves with the point as a rigid part; Displacement and Rotation are then those of "
        "the point, and - or nothing leaves them to the equilibrium with Force, Moment and the body.",
        Allowed::one_of({"distributing", "rigid"}));
      section.add(
        "Moment",
        boundary.moment,
        {"Total moment on the boundary about the centroid of its area [], as a traction w x (x - centroid), "
         "which has no resultant. Empty: none.",
         "force times length"},
        {"three expressions \"Mx; My; Mz\" in t"});
      section.add(
        "Displacement",
        "",
        {"Prescribed displacement []; - leaves a component free. normal: along the outward normal of the surface, free across "
         "it, as on rollers. Empty: all free.",
         "length"},
        {"three of: an expression, -, or exact, as in \"-, -, 0\"; exact for all three; or \"normal: an expression\""},
        [&boundary](const ParameterValue &value) {
          set_displacement(boundary, value);
        },
        "list of expressions");
      section.add(
        "Displacement axes",
        boundary.displacement_axes,
        {"Rotates the axes of Displacement about those of the scene, x, then y, then z [].",
         "degrees"},
        {"3 numbers"});
      section.add(
        "Rotation",
        boundary.rotation,
        {"Prescribed rotation of the boundary about the Reference point, a vector along the axis, added to the components "
         "that Displacement prescribes (all where that is empty) []. With finite strains it is a rotation by any angle, "
         "with small ones its linear part.",
         "degrees"},
        {"three expressions \"rx; ry; rz\" in t; with Coupling = rigid also - for what is free"});
      section.add(
        "Normal stiffness",
        boundary.normal_stiffness,
        {"An elastic foundation: springs between the boundary and the ground, with this traction per displacement along "
         "the normal []. Empty: none.",
         "force per volume"},
        {"an expression in x, y, z, positive"});
      section.add(
        "Tangential stiffness",
        boundary.tangential_stiffness,
        {"The same across the normal [], with a Normal stiffness. Empty: 0.",
         "force per volume"},
        {"an expression in x, y, z, positive; or 0"});
    }

    void
    set_ogden_terms(MaterialParameters &material, const ParameterValue &value)
    {
      material.ogden_terms.clear();
      for (const auto &[modulus, exponent] : pairs(value))
        material.ogden_terms.push_back({modulus, exponent});
    }

    void
    declare_nonlinear_constants(const ParameterSection &section,
                                MaterialParameters     &material)
    {
      const Allowed not_negative = {"0 or a positive number"};
      section.add("C10",
                  material.c10,
                  {"Constant of the first invariant of Law = Mooney-Rivlin [].",
                   "force per area"},
                  not_negative);
      section.add(
        "C01",
        material.c01,
        {"Constant of the second invariant of Law = Mooney-Rivlin [].",
         "force per area"},
        not_negative);
      section.add(
        "Ogden terms",
        "",
        {"Moduli and exponents of Law = Ogden, W = sum_p mu_p / alpha_p (sum_a l_a^alpha_p - 3) of isochoric stretches "
         "[].",
         "force per area; -"},
        {"\"mu_1, alpha_1; mu_2, alpha_2; ...\" with mu_p alpha_p > 0"},
        [&material](const ParameterValue &value) {
          set_ogden_terms(material, value);
        });
      Hardening &hardening = material.hardening;
      section.add("Yield stress",
                  hardening.yield_stress,
                  {"First yield stress of Law = J2 plasticity in tension [].",
                   "force per area"},
                  not_negative);
      section.add("Hardening modulus",
                  hardening.modulus,
                  {"Linear isotropic hardening: stress per plastic strain [].",
                   "force per area"},
                  not_negative);
      section.add(
        "Saturation stress",
        hardening.saturation_stress,
        {"Yield stress that exponential hardening, added to the linear one, ends at []. 0: none.",
         "force per area"},
        not_negative);
      section.add(
        "Saturation exponent",
        hardening.saturation_exponent,
        {"How fast it does so: the rest falls as exp(-exponent times plastic strain) [].",
         "-"},
        not_negative);
      section.add(
        "Kinematic hardening modulus",
        hardening.kinematic_modulus,
        {"Linear kinematic hardening (Prager): back stress per plastic strain in tension [].",
         "force per area"},
        not_negative);
      section.add(
        "Hardening table",
        "",
        {"Yield stress by equivalent plastic strain, linear between the points and constant beyond, in place of Yield "
         "stress, Hardening modulus and Saturation stress [].",
         "-, force per area"},
        {"\"strain, stress; strain, stress; ...\", strains ascending from 0, stresses not descending"},
        [&hardening](const ParameterValue &value) {
          hardening.table = pairs(value);
        });
    }

    void
    declare_material(const ParameterSection &section,
                     MaterialParameters     &material)
    {
      section.add(
        "Law",
        material.law,
        "Material law; each takes its own of the constants below. rigid: none; the body moves as a rigid part, "
        "whose motion follows from the equilibrium as far as nothing prescribes it.",
        Allowed::one_of(law_names()));
      section.add(
        "Strain",
        material.strain,
        "Measure of strain. small: of the undeformed body, for which rotations are small, too. finite: linear elastic "
        "and J2 plasticity then stand on the logarithmic strain. auto: finite for hyperelastic laws, else small.",
        Allowed::one_of({"auto", "small", "finite"}));
      section.add(
        "Young modulus",
        material.young_modulus,
        {"Young's modulus at small strain of Law = linear elastic, neo-Hookean, St. Venant-Kirchhoff and J2 plasticity "
         "[], which need one.",
         "force per area"},
        {"a positive number"});
      section.add(
        "Poisson ratio",
        material.poisson_ratio,
        {"Poisson's ratio at small strain of all laws but orthotropic [].",
         "-"},
        {"a number above -1 and not above 0.5"});
      declare_nonlinear_constants(section, material);
      Orthotropic &orthotropic = material.orthotropic;
      section.add(
        "Young moduli",
        orthotropic.young_moduli,
        {"E_x, E_y, E_z of Law = orthotropic, along the axes of the material "
         "[].",
         "force per area"},
        {"3 positive numbers"});
      section.add(
        "Poisson ratios",
        orthotropic.poisson_ratios,
        {"nu_xy, nu_yz, nu_zx of Law = orthotropic []; nu_ij is the contraction along j per "
         "extension along i under tension along i, nu_ij / E_i = nu_ji / E_j.",
         "-"},
        {"3 numbers with which the stiffness is positive definite"});
      section.add("Shear moduli",
                  orthotropic.shear_moduli,
                  {"G_xy, G_yz, G_zx of Law = orthotropic [].",
                   "force per area"},
                  {"3 positive numbers"});
      section.add(
        "Axes",
        orthotropic.axes,
        {"Rotates the axes of Law = orthotropic about those of the scene, x, then y, then z "
         "[]. They do not follow the Rotate of the mesh.",
         "degrees"},
        {"3 numbers"});
      section.add("Density",
                  material.density,
                  {"Mass density, on which Gravity acts []. 0: no weight.",
                   "mass per volume"},
                  {"0 or a positive number"});
      section.add(
        "Thermal expansion",
        material.thermal_expansion,
        {"Strain per Temperature of the body, the same in all directions [].",
         "1 / temperature"},
        {"a number"});
    }
  } // namespace

  void
  declare_body(const ParameterSection &section, BodyParameters &body)
  {
    section.add("Degree",
                body.degree,
                "Polynomial degree of the displacement.",
                Allowed::integer(min_degree, max_degree));
    section.add(
      "Degree by region",
      "",
      "Other degrees for cells with the given material ids of the mesh.",
      {"\"material id: degree; ...\", degrees from " +
       std::to_string(min_degree) + " to " + std::to_string(max_degree)},
      [&body](const ParameterValue &value) {
        set_degrees_by_region(body, value);
      });
    section.add(
      "Degree near",
      "",
      "Other degrees for cells with their centre or any vertex in a ball. The last ball that has a cell counts, and "
      "takes precedence over Degree by region.",
      {"entries \"x, y, z, radius, degree\" separated by ';', degrees from " +
       std::to_string(min_degree) + " to " + std::to_string(max_degree)},
      [&body](const ParameterValue &value) {
        body.degree_near =
          parse_balls(value.text, value.where, "degree", max_degree);
      });
    section.add(
      "Formulation",
      body.formulation,
      "Unknowns: displacement alone, or (mixed) displacement and pressure, the latter one degree lower, which does "
      "not lock and allows nu = 0.5. auto: mixed from nu = 0.49 on.",
      Allowed::one_of({"auto", "displacement", "mixed"}));
    section.add(
      "Body force",
      "auto",
      {"Force on the volume []. auto: the force that balances the exact solution if that is given by "
       "expressions (it then includes Gravity), else zero.",
       "force per volume"},
      {"three expressions \"bx; by; bz\" in x, y, z, t; exact; or auto"},
      [&body](const ParameterValue &value) {
        body.body_force.reset();
        if (value.text != "auto")
          value.read(body.body_force);
      },
      "list of expressions");
    section.add(
      "Displacement at",
      "",
      {"Prescribed displacements at points, or along the straight edges between two points; - leaves a component free "
       "[]. Points are vertices of the mesh on the surface of the body. They hold rigid motions; a force on them, or on a "
       "line, has infinite stress, and the displacement there grows as the mesh becomes finer.",
       "length"},
      {"entries \"x, y, z: ux, uy, uz\" or \"x, y, z, x2, y2, z2: ux, uy, uz\" separated by ';', as in \"0, 0, 0: 0, -, 0\""},
      [&body](const ParameterValue &value) {
        set_supports(body.supports, value);
      },
      "list of expressions");
    section.add(
      "Temperature",
      body.temperature,
      {"Temperature above that of the state without strain [], which acts by Thermal expansion. Empty: "
       "none.",
       "temperature"},
      {"an expression in x, y, z, t"});
    declare_mesh(section.subsection("Mesh"), body.mesh);
    declare_material(section.subsection("Material"), body.material);
    for (auto &[name, boundary] : body.boundaries)
      declare_boundary(section.subsection("Boundary " + name), boundary);
  }
} // namespace mortise
