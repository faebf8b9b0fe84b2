// A million people, and 20,000 beside them: whole frames by the processor alone.
#pragma once

namespace bench {

// Rows million/... of bench_frame.
void register_million();

}  // namespace bench
