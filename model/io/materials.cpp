#include "model/io/materials.h"

#include <algorithm>
#include <limits>

#include "model/input_file.h"

namespace model {

std::uint16_t number_of(const Material& material, std::vector<Material>& materials) {
    const auto found = std::find(materials.begin(), materials.end(), material);
    const auto number = found - materials.begin();
    if (number > std::numeric_limits<std::uint16_t>::max()) fail("more than 65,536 materials", "fewer");
    if (found == materials.end()) materials.push_back(material);
    return static_cast<std::uint16_t>(number);
}

}  // namespace model
