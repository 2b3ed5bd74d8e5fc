#include <mortise/output/face_picture.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    constexpr double width = 600., margin = 30.;

    /// Directions of the paper and towards the eye.
    struct View
    {
      explicit View(const double side)
        : towards(Point<3>(0.5 * side, -0.7 * side, 0.5 * side))
      {
        towards /= towards.norm();
        right = cross_product_3d(Tensor<1, 3>(Point<3>(0., 0., 1.)), towards);
        right /= right.norm();
        up = cross_product_3d(towards, right);
      }

      Tensor<1, 3> towards, right, up;
    };

    Tensor<1, 3>
    outer_normal(const PictureFace &face)
    {
      const auto  &x      = face.vertices;
      Tensor<1, 3> normal = cross_product_3d(x[1] - x[0], x[2] - x[0]);
      return normal / std::max(normal.norm(), 1e-300);
    }

    Point<3>
    middle(const PictureFace &face)
    {
      Tensor<1, 3> sum;
      for (const Point<3> &x : face.vertices)
        sum += x;
      return Point<3>(sum / double(face.vertices.size()));
    }

    /// Hues that are far apart for numbers that follow each other.
    std::string
    colour(const unsigned int number, const double brightness)
    {
      const double       hue = std::fmod(number * 137.50776405, 360.);
      std::ostringstream text;
      text << "hsl(" << std::lround(hue) << ",55%,"
           << std::lround(35. + 40. * brightness) << "%)";
      return text.str();
    }

    struct Window
    {
      double left   = std::numeric_limits<double>::max();
      double right  = -std::numeric_limits<double>::max();
      double bottom = std::numeric_limits<double>::max();
      double top    = -std::numeric_limits<double>::max();
    };

    Window
    window_of(const std::vector<PictureFace> &faces, const View &view)
    {
      Window window;
      for (const PictureFace &face : faces)
        for (const Point<3> &x : face.vertices)
          {
            window.left   = std::min(window.left, x * view.right);
            window.right  = std::max(window.right, x * view.right);
            window.bottom = std::min(window.bottom, x * view.up);
            window.top    = std::max(window.top, x * view.up);
          }
      return window;
    }

    /// Faces that look at the eye, the farthest first.
    std::vector<const PictureFace *>
    seen_faces(const std::vector<PictureFace> &faces, const View &view)
    {
      std::vector<std::pair<double, const PictureFace *>> order;
      for (const PictureFace &face : faces)
        if (outer_normal(face) * view.towards > 0.)
          order.emplace_back(middle(face) * view.towards, &face);
      std::stable_sort(order.begin(),
                       order.end(),
                       [](const auto &a, const auto &b) {
                         return a.first < b.first;
                       });
      std::vector<const PictureFace *> result;
      for (const auto &face : order)
        result.push_back(face.second);
      return result;
    }

    /// Where the labels go: the middle of the face that is nearest to the mean
    /// of those that are seen.
    std::map<unsigned int, Point<3>>
    label_places(const std::vector<const PictureFace *> &seen)
    {
      std::map<unsigned int, std::pair<Tensor<1, 3>, unsigned int>> sums;
      for (const PictureFace *face : seen)
        {
          sums[face->number].first += middle(*face);
          ++sums[face->number].second;
        }
      std::map<unsigned int, Point<3>> places;
      for (const PictureFace *face : seen)
        {
          const auto    &sum = sums.at(face->number);
          const Point<3> mean(sum.first / double(sum.second));
          const auto     place = places.emplace(face->number, middle(*face));
          if (middle(*face).distance(mean) < place.first->second.distance(mean))
            place.first->second = middle(*face);
        }
      return places;
    }

    /// Returns the height that the view takes.
    double
    draw(const std::vector<PictureFace> &faces,
         const View                     &view,
         const double                    offset,
         std::ostream                   &out)
    {
      const Window window = window_of(faces, view);
      const double scale =
        (width - 2. * margin) /
        std::max(
          {window.right - window.left, window.top - window.bottom, 1e-300});
      const auto place = [&](const Point<3> &x) {
        return std::make_pair(offset + margin +
                                scale * (x * view.right - window.left),
                              margin + scale * (window.top - x * view.up));
      };
      const auto seen = seen_faces(faces, view);
      for (const PictureFace *face : seen)
        {
          out << "<polygon points=\"";
          for (const Point<3> &x : face->vertices)
            out << place(x).first << "," << place(x).second << " ";
          const std::string fill =
            colour(face->number, outer_normal(*face) * view.towards);
          out << "\" fill=\"" << fill << "\" stroke=\"" << fill << "\"/>\n";
        }
      for (const auto &[number, x] : label_places(seen))
        out << "<text x=\"" << place(x).first << "\" y=\"" << place(x).second
            << "\">" << number << "</text>\n";
      return 2. * margin + scale * (window.top - window.bottom);
    }
  } // namespace

  std::string
  face_picture(const std::vector<PictureFace> &faces)
  {
    std::ostringstream body;
    body.precision(6);
    const double       height = std::max(draw(faces, View(1.), 0., body),
                                   draw(faces, View(-1.), width, body));
    std::ostringstream text;
    text << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 "
         << 2. * width << " " << height
         << "\" font-family=\"sans-serif\" font-size=\"14\" "
            "text-anchor=\"middle\">\n<rect width=\"100%\" height=\"100%\" "
            "fill=\"white\"/>\n"
         << body.str() << "</svg>\n";
    return text.str();
  }
} // namespace mortise
