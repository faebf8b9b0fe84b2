// libFuzzer's entry: the same bytes into every law and rival. With clang and -DGRANDSTAND_FUZZ=ON:
// bin/controller_fuzz -max_total_time=60 CORPUS
#include <cstdio>
#include <cstdlib>

#include "tests/fuzz/calls.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    for (const std::string_view name : sfsm::fuzz::all_names()) {
        const auto law = sfsm::fuzz::make_any(name);
        const std::string broken = sfsm::fuzz::call(*law, {data, size}, sfsm::fuzz::Forecasts::hostile).broken;
        if (broken.empty()) continue;
        std::fprintf(stderr, "%.*s: %s\n", static_cast<int>(name.size()), name.data(), broken.c_str());
        std::abort();
    }
    return 0;
}
