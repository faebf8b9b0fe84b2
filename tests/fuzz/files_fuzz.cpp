// libFuzzer's entry: the bytes as a file whose name ends in GRANDSTAND_FUZZ_EXTENSION, or as an image. Built by the
// preset `fuzz` (clang), together with the files to begin from:
//   bin/fuzz_seeds SEEDS && bin/gltf_fuzz -max_total_time=600 NEW SEEDS/gltf
// and obj_fuzz, ply_fuzz, stl_fuzz, off_fuzz, gzip_fuzz, image_fuzz, pts_fuzz alike.
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

#include "model/io/image.h"
#include "pointsample/points_file.h"
#include "tests/fuzz/containers.h"
#include "tests/model/use_file.h"

namespace {

constexpr std::string_view extension = GRANDSTAND_FUZZ_EXTENSION;

void require(bool holds) {
    if (!holds) std::abort();
}

void use(const std::filesystem::path& path) {
    if (extension != ".pts") return tests::use_mesh_file(path);
    const pointsample::PointModel model = pointsample::PointsFile(path).unpack();
    for (const glm::vec3& position : model.positions) require(std::isfinite(position.x + position.y + position.z));
}

void use(const std::uint8_t* data, std::size_t size) {
    if (extension == ".image") {
        const model::Texture texture = model::decode_image({data, size});
        require(texture.width > 0 && texture.height > 0 &&
                texture.texels.size() == static_cast<std::size_t>(texture.width) * texture.height);
        return;
    }
    static const std::filesystem::path path = std::filesystem::temp_directory_path() /
                                              ("grandstand_fuzz_" + std::to_string(getpid()) + std::string(extension));
    std::filesystem::remove(path);
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
    use(path);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        use(data, size);
    } catch (const std::runtime_error& error) {
        require(std::string(error.what()).find_first_of("\r\n") == std::string::npos);
    }
    return 0;
}

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

namespace {

// Its size and its checksum are put right.
std::size_t mutate_points(std::uint8_t* data, std::size_t size, std::size_t most) {
    size = LLVMFuzzerMutate(data, size, most);
    std::uint64_t word = size;
    if (size < 24 + sizeof word) return size;
    std::memcpy(data + 16, &word, sizeof word);
    word = XXH3_64bits(data, size - sizeof word);
    std::memcpy(data + size - sizeof word, &word, sizeof word);
    return size;
}

std::string mutated(std::string bytes, std::size_t most) {
    const std::size_t size = bytes.size();
    bytes.resize(std::max(most, size));
    bytes.resize(LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(bytes.data()), size, bytes.size()));
    return bytes;
}

// One of a GLB's chunks, more often its data, which keeps its size: what the document says of it stays true.
std::string mutated_glb(const std::string& whole, std::size_t most, unsigned seed) {
    fuzz::Glb glb = fuzz::parts_of_glb(whole);
    if (glb.json.empty() || seed % 8 == 0) return mutated(whole, most);
    if (seed % 8 < 3 || glb.binary.empty()) {
        glb.json = mutated(glb.json, most - whole.size() + glb.json.size());
    } else {
        const std::size_t size = glb.binary.size();
        glb.binary = mutated(glb.binary, size);
        glb.binary.resize(size, '\0');
    }
    return fuzz::glb_of(glb);
}

std::string mutated_gzip(const std::string& whole, std::size_t most, unsigned seed) {
    constexpr std::size_t most_inside = std::size_t{1} << 16;
    const std::string inside = fuzz::unpacked_gzip(whole, most_inside);
    return inside.empty() || seed % 4 == 0 ? mutated(whole, most) : tests::gzip(mutated(inside, most_inside));
}

}  // namespace

// Behind a checksum or a length that is wrong nothing would be found.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed) {
    const bool gzip = extension.ends_with(".gz");
    if (extension == ".pts") return mutate_points(data, size, most);
    if (extension != ".glb" && !gzip) return LLVMFuzzerMutate(data, size, most);
    const std::string whole(reinterpret_cast<const char*>(data), size);
    const std::string out = gzip ? mutated_gzip(whole, most, seed) : mutated_glb(whole, most, seed);
    if (out.size() > most) return LLVMFuzzerMutate(data, size, most);
    std::memcpy(data, out.data(), out.size());
    return out.size();
}
