#include "sfsm/recordings/text_source.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <new>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>

namespace sfsm {

class TextSource::Layer : public std::streambuf {
public:
    // What is read and not yet taken: at first the first bytes.
    std::string_view head() {
        underflow();
        return {gptr(), static_cast<std::size_t>(egptr() - gptr())};
    }

    static constexpr std::size_t block = std::size_t{64} << 10;

protected:
    virtual std::size_t fill(std::span<char> room) = 0;  // how many bytes came; 0: the end

    int_type underflow() override {
        if (gptr() == egptr()) {
            const std::size_t count = fill(bytes_);
            setg(bytes_.data(), bytes_.data(), bytes_.data() + count);
        }
        return gptr() == egptr() ? traits_type::eof() : traits_type::to_int_type(*gptr());
    }

private:
    std::array<char, block> bytes_;
};

namespace {

std::size_t read_from(std::streambuf& below, std::span<char> room) {
    return static_cast<std::size_t>(below.sgetn(room.data(), static_cast<std::streamsize>(room.size())));
}

class FileBytes : public TextSource::Layer {
public:
    FileBytes(std::istream& in, const std::string& name) : in_(in), name_(name) {}

private:
    std::size_t fill(std::span<char> room) override {
        in_.read(room.data(), static_cast<std::streamsize>(room.size()));
        if (in_.bad()) throw std::runtime_error(name_ + ":1: found a file that can't be read on, expected a recording");
        return static_cast<std::size_t>(in_.gcount());
    }

    std::istream& in_;
    std::string name_;
};

constexpr std::string_view gzip_magic = "\x1f\x8b";

// Member after member.
class Unpacked : public TextSource::Layer {
public:
    Unpacked(std::streambuf& packed, const std::string& name) : below_(packed), name_(name) {
        constexpr int gzip = 16;  // and no other
        if (inflateInit2(&stream_, MAX_WBITS + gzip) != Z_OK) throw std::bad_alloc();
    }
    ~Unpacked() override { inflateEnd(&stream_); }

private:
    std::size_t fill(std::span<char> room) override {
        stream_.next_out = reinterpret_cast<Bytef*>(room.data());
        stream_.avail_out = static_cast<uInt>(room.size());
        while (stream_.avail_out == room.size() && has_packed()) inflate_some();
        const std::size_t count = room.size() - stream_.avail_out;
        unpacked_ += count;
        constexpr std::uint64_t always_passed = std::uint64_t{8} << 20, most_times = 100;
        if (unpacked_ > always_passed && unpacked_ / most_times > packed_)
            fail("gzip data that swells to over 100 times its size", "a recording");
        return count;
    }

    // False at the end of the last member; behind it only padding may stand.
    bool has_packed() {
        if (stream_.avail_in == 0) {
            stream_.avail_in = static_cast<uInt>(read_from(below_, packed_bytes_));
            stream_.next_in = reinterpret_cast<Bytef*>(packed_bytes_.data());
            packed_ += stream_.avail_in;
        }
        if (stream_.avail_in == 0 && !is_at_member_end_) fail("gzip data that is cut short", "all of it");
        if (stream_.avail_in == 0) return false;
        if (is_at_member_end_ && *stream_.next_in != static_cast<Bytef>(gzip_magic[0])) return false;
        if (is_at_member_end_) inflateReset(&stream_);
        return true;
    }

    void inflate_some() {
        const int result = inflate(&stream_, Z_NO_FLUSH);
        is_at_member_end_ = result == Z_STREAM_END;
        if (result != Z_OK && result != Z_STREAM_END) fail("gzip data that is damaged", "data that unpacks");
    }

    [[noreturn]] void fail(const std::string& found, const std::string& expected) const {
        throw std::runtime_error(name_ + ":1: found " + found + ", expected " + expected);
    }

    std::streambuf& below_;
    std::string name_;
    z_stream stream_{};
    std::array<char, block> packed_bytes_;
    std::uint64_t packed_ = 0, unpacked_ = 0;
    bool is_at_member_end_ = false;
};

enum class Order { little_endian, big_endian };

// UTF-16 to UTF-8. Halves of pairs without the other become U+FFFD, half a unit at the end is left out.
class FromUtf16 : public TextSource::Layer {
public:
    FromUtf16(std::streambuf& below, Order order) : below_(below), order_(order) {}

private:
    static constexpr char32_t mark = 0xFEFF, replacement = 0xFFFD;

    std::size_t fill(std::span<char> room) override {
        to_ = room.data();
        while (to_ == room.data()) {
            const std::size_t count = read_from(below_, units_);
            for (std::size_t i = 0; i + 1 < count; i += 2) take_unit(unit(units_[i], units_[i + 1]));
            if (count >= 2) continue;
            if (high_ != 0) put(replacement);
            high_ = 0;
            break;
        }
        return static_cast<std::size_t>(to_ - room.data());
    }

    char32_t unit(char first, char second) const {
        const auto a = static_cast<unsigned char>(first), b = static_cast<unsigned char>(second);
        return order_ == Order::little_endian ? a | char32_t{b} << 8 : b | char32_t{a} << 8;
    }

    void take_unit(char32_t unit) {
        const char32_t high = std::exchange(high_, 0);
        const bool is_low = unit >= 0xDC00 && unit < 0xE000;
        if (high != 0 && is_low) return put(0x10000 + ((high - 0xD800) << 10) + (unit - 0xDC00));
        if (high != 0) put(replacement);
        if (unit >= 0xD800 && unit < 0xDC00) {
            high_ = unit;
        } else {
            put(is_low ? replacement : unit);
        }
    }

    void put(char32_t character) {
        const auto tail = [&](int shift) { *to_++ = static_cast<char>(0x80 | ((character >> shift) & 0x3F)); };
        if (character == mark) return;
        if (character < 0x80) {
            *to_++ = static_cast<char>(character);
        } else if (character < 0x800) {
            *to_++ = static_cast<char>(0xC0 | character >> 6);
            tail(0);
        } else if (character < 0x10000) {
            *to_++ = static_cast<char>(0xE0 | character >> 12);
            tail(6);
            tail(0);
        } else {
            *to_++ = static_cast<char>(0xF0 | character >> 18);
            tail(12);
            tail(6);
            tail(0);
        }
    }

    std::streambuf& below_;
    Order order_;
    char32_t high_ = 0;                    // the first half of a pair, that waits for the other; 0: none
    std::array<char, block / 2> units_{};  // a unit of two bytes becomes three at most, and one may wait
    char* to_ = nullptr;
};

// Of text that begins with ASCII, as headers do, without a mark.
std::optional<Order> order_by_zeros(std::string_view head) {
    constexpr std::size_t enough = 64, fewest = 4;
    const std::size_t count = std::min(head.size(), enough) / 2 * 2;
    if (count < fewest) return std::nullopt;
    std::array<std::size_t, 2> zeros{};
    for (std::size_t i = 0; i < count; ++i) zeros[i % 2] += head[i] == '\0';
    if (zeros[0] == 0 && zeros[1] == count / 2) return Order::little_endian;
    if (zeros[1] == 0 && zeros[0] == count / 2) return Order::big_endian;
    return std::nullopt;
}

std::optional<Order> order_by_mark(std::string_view head) {
    if (head.starts_with("\xFF\xFE")) return Order::little_endian;
    if (head.starts_with("\xFE\xFF")) return Order::big_endian;
    return std::nullopt;
}

}  // namespace

TextSource::TextSource(std::istream& in, const std::string& name) {
    layers_.push_back(std::make_unique<FileBytes>(in, name));
    if (layers_.back()->head().starts_with(gzip_magic))
        layers_.push_back(std::make_unique<Unpacked>(*layers_.back(), name));
    std::optional<Order> order = order_by_mark(layers_.back()->head());
    if (!order) {
        order = order_by_zeros(layers_.back()->head());
        if (order) notes_.emplace_back("every second byte is 0: read as UTF-16 without a mark");
    }
    if (order) layers_.push_back(std::make_unique<FromUtf16>(*layers_.back(), *order));
    stream_.rdbuf(layers_.back().get());
    stream_.exceptions(std::ios::badbit);  // what the layers throw goes on
}

TextSource::~TextSource() = default;

}  // namespace sfsm
