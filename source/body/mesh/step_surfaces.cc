#include <deal.II/base/config.h>

#include <mortise/base/error.h>
#include <mortise/base/quotes.h>
#include <mortise/body/mesh/surfaces.h>

#ifdef DEAL_II_WITH_OPENCASCADE
#  include <deal.II/opencascade/utilities.h>

#  include <BRepAdaptor_Surface.hxx>
#  include <BRepBndLib.hxx>
#  include <BRep_Tool.hxx>
#  include <Bnd_Box.hxx>
#  include <GeomLProp_SLProps.hxx>
#  include <ShapeAnalysis_Surface.hxx>
#  include <TopExp_Explorer.hxx>
#  include <TopoDS.hxx>
#  include <TopoDS_Face.hxx>
#endif

namespace mortise
{
  using namespace dealii;

#ifdef DEAL_II_WITH_OPENCASCADE
  namespace
  {
    /// One face, without its limits: as far as its parametrisation goes.
    class StepFace : public Surface
    {
    public:
      StepFace(const TopoDS_Face &face, const RigidMotion &motion)
        : face(face)
        , surface(BRep_Tool::Surface(face))
        , motion(motion)
      {
        Bnd_Box box;
        BRepBndLib::Add(face, box);
        extent = std::sqrt(box.SquareExtent());
      }

      Distance
      distance(const Point<3> &at) const override
      {
        constexpr double      precision = 1e-12;
        const Point<3>        x         = motion.inverse(at);
        ShapeAnalysis_Surface analysis(surface);
        const gp_Pnt2d        uv =
          analysis.ValueOfUV(gp_Pnt(x[0], x[1], x[2]), precision);
        GeomLProp_SLProps  properties(surface, uv.X(), uv.Y(), 1, precision);
        const gp_Pnt       foot = properties.Value();
        const Tensor<1, 3> from = x - Point<3>(foot.X(), foot.Y(), foot.Z());
        if (!properties.IsNormalDefined())
          return {from.norm(), motion.rotation * (from / from.norm())};
        const gp_Dir       n      = properties.Normal();
        const Tensor<1, 3> normal = Point<3>(n.X(), n.Y(), n.Z());
        return {from * normal, motion.rotation * normal};
      }

      SurfacePointer
      moved(const RigidMotion &next) const override
      {
        RigidMotion both;
        both.rotation = next.rotation * motion.rotation;
        both.translation =
          next.rotation * motion.translation + next.translation;
        return std::make_shared<StepFace>(face, both);
      }

      double
      size() const override
      {
        return extent;
      }

      std::string
      text() const override
      {
        return "face of a STEP file";
      }

    private:
      const TopoDS_Face face;
      const Handle(Geom_Surface) surface;
      const RigidMotion motion;
      double            extent = 0.;
    };
  } // namespace

  std::vector<SurfacePointer>
  read_step_faces(const std::string &file_name, const std::string &where)
  {
    std::vector<SurfacePointer> faces;
    try
      {
        // 1: gmsh keeps the numbers of the file, too
        const TopoDS_Shape shape = OpenCASCADE::read_STEP(file_name, 1.);
        for (TopExp_Explorer face(shape, TopAbs_FACE); face.More(); face.Next())
          faces.push_back(
            std::make_shared<StepFace>(TopoDS::Face(face.Current()),
                                       RigidMotion()));
      }
    catch (...)
      {
        faces.clear();
      }
    if (faces.empty())
      throw InputError(where + ": the STEP file " +
                       file_in_quotes(file_name, '\'') +
                       " cannot be read or has no faces");
    return faces;
  }
#else
  std::vector<SurfacePointer>
  read_step_faces(const std::string &, const std::string &where)
  {
    throw InputError(
      where + ": shapes from STEP files need a deal.II with OpenCASCADE; "
              "allowed here: sphere, cylinder");
  }
#endif
} // namespace mortise
