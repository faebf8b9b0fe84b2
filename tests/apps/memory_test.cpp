// What memory is said to be left, by a machine of files.
#include "apps/memory.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/command.h"

namespace {

class Memory : public testing::Test {
protected:
    void write(const std::string& name, const std::string& text) const {
        const std::filesystem::path path = root_ / name;
        std::filesystem::create_directories(path.parent_path());
        std::ofstream(path) << text;
    }
    std::uint64_t left() const { return apps::available_memory(root_ / "").bytes; }

    tests::Directory root_;
};

TEST_F(Memory, IsWhatTheMachineSaysIsAvailable) {
    write("proc/meminfo", "MemTotal:       8000000 kB\nMemFree:  10 kB\nMemAvailable:    3000000 kB\n");
    EXPECT_EQ(left(), 3'000'000u * 1024);
    EXPECT_EQ(apps::available_memory(root_ / "").of, "on this machine");
}

TEST_F(Memory, IsWithoutLimitWhereNothingSaysOne) {
    EXPECT_NO_THROW(apps::require_memory(10'000'000, 16384, 16384, apps::available_memory(root_ / "")));
}

TEST_F(Memory, IsWhatControlGroupsLeaveIfThatIsLess) {
    write("proc/meminfo", "MemAvailable: 3000000 kB\n");
    write("proc/self/cgroup", "0::/outer/inner\n");
    write("sys/fs/cgroup/outer/inner/memory.max", "max\n");
    write("sys/fs/cgroup/outer/inner/memory.current", "100\n");
    EXPECT_EQ(left(), 3'000'000u * 1024);
    write("sys/fs/cgroup/outer/memory.max", "1000000000\n");
    write("sys/fs/cgroup/outer/memory.current", "300000000\n");
    EXPECT_EQ(left(), 700'000'000u);
    write("sys/fs/cgroup/outer/memory.stat", "anon 5\ninactive_file 100000000\n");
    EXPECT_EQ(left(), 800'000'000u) << "files that are kept can be let go";
    write("sys/fs/cgroup/outer/memory.current", "2000000000\n");
    EXPECT_EQ(left(), 0u);
    EXPECT_EQ(apps::available_memory(root_ / "").of, "in its control group");
}

TEST_F(Memory, KnowsControlGroupsOfTheFirstVersion) {
    write("proc/meminfo", "MemAvailable: 3000000 kB\n");
    write("proc/self/cgroup", "5:cpu:/\n4:memory:/of/the/host\n0::/\n");
    write("sys/fs/cgroup/memory/memory.limit_in_bytes", "500000000\n");
    write("sys/fs/cgroup/memory/memory.usage_in_bytes", "200000000\n");
    EXPECT_EQ(left(), 300'000'000u);
    write("sys/fs/cgroup/memory/memory.limit_in_bytes", "9223372036854771712\n");
    EXPECT_EQ(left(), 3'000'000u * 1024);
}

TEST_F(Memory, ARunThatMayNeedMoreIsRefusedAndSaysWhatAndWhy) {
    const std::uint64_t most = apps::most_memory(1'000'000, 640, 360);
    EXPECT_NO_THROW(apps::require_memory(1'000'000, 640, 360, {most, "on this machine"}));
    try {
        apps::require_memory(1'000'000, 640, 360, {most / 3, "on this machine"});
        FAIL();
    } catch (const std::runtime_error& error) {
        const std::string said = error.what();
        EXPECT_NE(said.find("found " + apps::bytes_text(most / 3) + " left on this machine"), said.npos) << said;
        EXPECT_NE(said.find("expected " + apps::bytes_text(most)), said.npos) << said;
        EXPECT_NE(said.find("1000000 people at 640x360"), said.npos) << said;
    }
}

TEST_F(Memory, IsWrittenInThreeDigitsAtMost) {
    EXPECT_EQ(apps::bytes_text(281'400'000), "281 MB");
    EXPECT_EQ(apps::bytes_text(5'800'000'000), "5.8 GB");
}

}  // namespace
