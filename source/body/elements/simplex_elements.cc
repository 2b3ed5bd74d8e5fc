#include <mortise/body/elements/simplex_elements.h>

#include <algorithm>

namespace mortise
{
  using namespace dealii;

  SimplexElements::SimplexElements(const std::vector<unsigned int> &degrees,
                                   const unsigned int              n_components,
                                   const std::vector<VertexOrder> &orders)
    : degrees(degrees)
    , orders(orders)
  {
    for (const unsigned int degree : degrees)
      for (const VertexOrder &order : orders)
        if (n_components == 1)
          collection.push_back(FE_SimplexLegendre(degree, order));
        else
          collection.push_back(
            *make_simplex_system(FE_SimplexLegendre(degree, order),
                                 n_components));
  }

  unsigned int
  SimplexElements::index(const Triangulation<3>::cell_iterator &cell,
                         const unsigned int                     degree) const
  {
    const auto order =
      std::find(orders.begin(), orders.end(), vertex_order(cell));
    AssertThrow(order != orders.end(),
                ExcMessage("SimplexElements: the vertices of a cell are in an "
                           "order for which there is no element; try "
                           "order_vertices() on the coarse cells"));
    const auto place = std::find(degrees.begin(), degrees.end(), degree);
    AssertThrow(place != degrees.end(),
                ExcMessage("SimplexElements: there is no element of degree " +
                           std::to_string(degree)));
    return (place - degrees.begin()) * orders.size() + (order - orders.begin());
  }

  const FE_SimplexLegendre &
  SimplexElements::base(const FiniteElement<3> &element)
  {
    const auto *const simplex =
      dynamic_cast<const FE_SimplexLegendre *>(&element.base_element(0));
    AssertThrow(element.n_base_elements() == 1 && simplex != nullptr,
                ExcMessage("the elements must be FE_SimplexLegendre or "
                           "FESystem(FE_SimplexLegendre(p), n); got " +
                           element.get_name()));
    return *simplex;
  }
} // namespace mortise
