// Texts as gzip packs them and as UTF-16.
#pragma once

#include <zlib.h>

#include <cstdlib>
#include <string>

namespace sfsm {

inline std::string gzip(std::string text) {
    z_stream stream{};
    if (deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, MAX_WBITS + 16, 8, Z_DEFAULT_STRATEGY) != Z_OK)
        std::abort();
    std::string packed(deflateBound(&stream, text.size()) + 64, '\0');
    stream.next_in = reinterpret_cast<Bytef*>(text.data());
    stream.avail_in = static_cast<uInt>(text.size());
    stream.next_out = reinterpret_cast<Bytef*>(packed.data());
    stream.avail_out = static_cast<uInt>(packed.size());
    if (deflate(&stream, Z_FINISH) != Z_STREAM_END) std::abort();
    packed.resize(stream.total_out);
    deflateEnd(&stream);
    return packed;
}

// Two bytes a unit.
inline std::string utf16(const std::u16string& text, bool is_big_endian) {
    std::string bytes;
    for (const char16_t unit : text) {
        const char low = static_cast<char>(unit & 0xff), high = static_cast<char>(unit >> 8);
        bytes += is_big_endian ? high : low;
        bytes += is_big_endian ? low : high;
    }
    return bytes;
}
inline std::string utf16(const std::string& ascii, bool is_big_endian) {
    return utf16(std::u16string(ascii.begin(), ascii.end()), is_big_endian);
}

}  // namespace sfsm
