#include "model/io/gltf_packed.h"

#include <utility>

namespace model {

int add_unpacked(GltfFile& file, std::vector<unsigned char> bytes) {
    tinygltf::BufferView view;
    view.buffer = static_cast<int>(file.model.buffers.size());
    view.byteLength = bytes.size();
    file.model.buffers.emplace_back().data = std::move(bytes);
    file.model.bufferViews.push_back(std::move(view));
    return static_cast<int>(file.model.bufferViews.size()) - 1;
}

std::uint32_t whole_number(const tinygltf::Value& object, const char* name, const std::string& user) {
    const bool given = object.IsObject() && object.Has(name) && object.Get(name).IsInt();
    const int number = given ? object.Get(name).GetNumberAsInt() : -1;
    if (number < 0) fail(user + " without " + in_quotes(name), "a whole number from 0");
    return static_cast<std::uint32_t>(number);
}

}  // namespace model
