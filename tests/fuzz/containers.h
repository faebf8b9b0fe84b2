// What a container holds, so that it can be changed inside.
#pragma once

#include <zlib.h>

#include <cstdint>
#include <cstring>
#include <string>

#include "tests/model/gltf_builder.h"
#include "tests/model/gzip.h"

namespace fuzz {

struct Glb {
    std::string json, binary;
};

// Of one whose lengths are right; nothing of others.
inline Glb parts_of_glb(const std::string& bytes) {
    const auto word_at = [&](std::size_t at) {
        std::uint32_t word = 0;
        std::memcpy(&word, bytes.data() + at, sizeof word);
        return std::size_t{word};
    };
    if (bytes.size() < 20 || !bytes.starts_with("glTF") || word_at(12) > bytes.size() - 20) return {};
    Glb glb{bytes.substr(20, word_at(12)), {}};
    const std::size_t next = 20 + glb.json.size();
    if (next + 8 <= bytes.size() && word_at(next) <= bytes.size() - next - 8)
        glb.binary = bytes.substr(next + 8, word_at(next));
    return glb;
}

inline std::string glb_of(const Glb& glb) {
    return tests::make_glb(glb.json, glb.binary);
}

// The first `most` bytes of what is packed; nothing of what is damaged.
inline std::string unpacked_gzip(const std::string& packed, std::size_t most) {
    z_stream stream{};
    if (inflateInit2(&stream, MAX_WBITS + 16) != Z_OK) return {};
    std::string out(most, '\0');
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
    stream.avail_in = static_cast<uInt>(packed.size());
    stream.next_out = reinterpret_cast<Bytef*>(out.data());
    stream.avail_out = static_cast<uInt>(out.size());
    const int result = inflate(&stream, Z_FINISH);
    out.resize(result == Z_STREAM_END || result == Z_BUF_ERROR ? stream.total_out : 0);
    inflateEnd(&stream);
    return out;
}

}  // namespace fuzz
