// libFuzzer's entry: the bytes as a file whose name ends in GRANDSTAND_FUZZ_EXTENSION. With clang and
// -DGRANDSTAND_FUZZ=ON: bin/obj_fuzz -max_total_time=60 CORPUS, and gltf_fuzz, ply_fuzz, pts_fuzz alike.
#include <unistd.h>
#include <xxhash.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>

#include "model/io/mesh_file.h"
#include "pointsample/points_file.h"

namespace {

constexpr std::string_view extension = GRANDSTAND_FUZZ_EXTENSION;

void require(bool holds) {
    if (!holds) std::abort();
}

void use(const std::filesystem::path& path) {
    if (extension == ".pts") {
        const pointsample::PointModel model = pointsample::PointsFile(path).unpack();
        for (const glm::vec3& position : model.positions) require(std::isfinite(position.x + position.y + position.z));
        return;
    }
    const model::Mesh mesh = model::load_mesh(path).mesh;
    const std::size_t count = mesh.vertex_count();
    require(!mesh.indices.empty() && mesh.normals.size() == count && mesh.uvs.size() == count &&
            mesh.colors.size() == count && mesh.slots.size() == count && mesh.material_ids.size() == count &&
            mesh.joints.size() == count && mesh.weights.size() == count &&
            (mesh.more_joints.empty() || mesh.more_joints.size() == count) &&
            mesh.more_weights.size() == mesh.more_joints.size());
    for (const std::uint32_t index : mesh.indices) require(index < count);
    for (const glm::vec3& p : mesh.positions) require(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const std::filesystem::path path = std::filesystem::temp_directory_path() /
                                              ("grandstand_fuzz_" + std::to_string(getpid()) + std::string(extension));
    std::filesystem::remove(path);
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
    try {
        use(path);
    } catch (const std::runtime_error& error) {
        require(std::string(error.what()).find_first_of("\r\n") == std::string::npos);
    }
    return 0;
}

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

// Behind a checksum nothing would be found: it is put right, as is the file's size.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, unsigned) {
    size = LLVMFuzzerMutate(data, size, most);
    std::uint64_t word = size;
    if (extension != ".pts" || size < 24 + sizeof word) return size;
    std::memcpy(data + 16, &word, sizeof word);
    word = XXH3_64bits(data, size - sizeof word);
    std::memcpy(data + size - sizeof word, &word, sizeof word);
    return size;
}
