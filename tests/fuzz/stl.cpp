#include "fuzz/attempt.hpp"
#include "fuzz/readers.hpp"

#include "scree/io/stl.hpp"

namespace scree::test {

void read_as_stl(std::string_view bytes) {
  const auto file = file_with("mesh.stl", bytes);
  attempt(file.string(), [&] {
    const TriangleMesh mesh = read_stl(file, {.max_facets = 10000});
    insist(!mesh.facets.empty() && mesh.facets.size() <= 10000, "a mesh has no facets, or too many");
    for (const auto& facet : mesh.facets) {
      for (const auto corner : facet) {
        insist(corner < mesh.vertices.size(), "a facet has a corner that is not there");
        insist(mesh.vertices[corner].allFinite(), "a corner is not finite");
      }
    }
  });
}

} // namespace scree::test
