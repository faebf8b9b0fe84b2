// The shell scripts, with stand-ins for what they call: nothing is installed or built.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/command.h"

namespace {

namespace fs = std::filesystem;

class Scripts : public testing::Test {
protected:
    void SetUp() override {
        for (const char* folder : {"tools", "tmp", "root/scripts", "root/build/release/bin", "elsewhere"})
            fs::create_directories(directory_ / folder);
        for (const char* script : {"scripts/setup", "scripts/bundle", "demo", "test", "bench"})
            fs::copy_file(fs::path(GRANDSTAND_SOURCE) / script, directory_ / ("root/" + std::string(script)));
        // All that the scripts may find, besides what a test adds.
        for (const std::string tool : {"cat", "dirname", "env", "grep", "id", "mkdir", "mktemp", "rm", "tail", "tr"})
            fs::create_symlink(fs::exists("/usr/bin/" + tool) ? "/usr/bin/" + tool : "/bin/" + tool,
                               directory_ / ("tools/" + tool));
    }

    void stand_in(const std::string& path, const std::string& body) const {
        std::ofstream(directory_ / path) << "#!/bin/sh\n" << body << '\n';
        fs::permissions(directory_ / path, fs::perms::owner_all);
    }

    // Called from `elsewhere`; both streams are kept as one.
    tests::Outcome call(const std::string& script, const std::string& arguments = "") const {
        const std::string command = "cd " + (directory_ / "elsewhere") + " && TMPDIR=" + (directory_ / "tmp") +
                                    " PATH=" + (directory_ / "tools") + " " +
                                    (directory_ / ("root/" + std::string(script))) + " " + arguments + " >" +
                                    (directory_ / "said") + " 2>&1";
        const int code = tests::code_of(std::system(command.c_str()));
        EXPECT_TRUE(fs::is_empty(directory_ / "tmp")) << "a log is left behind";
        return {code, tests::read_file(directory_ / "said"), ""};
    }

    tests::Directory directory_;
};

TEST_F(Scripts, SetupPrintsTheListWhereThereIsNoAptAndNoCmake) {
    const tests::Outcome outcome = call("scripts/setup");
    EXPECT_EQ(outcome.code, 1);
    EXPECT_NE(outcome.out.find("no apt-get and no c++ cmake"), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.out.find("libglm-dev"), std::string::npos) << outcome.out;
}

TEST_F(Scripts, SetupPrintsTheListWhereThereIsNoAptAndALibraryIsMissing) {
    for (const char* tool : {"c++", "ninja", "pkg-config"}) stand_in(std::string("tools/") + tool, "exit 0");
    stand_in("tools/cmake", "echo no Embree; exit 1");
    const tests::Outcome outcome = call("scripts/setup");
    EXPECT_EQ(outcome.code, 1);
    EXPECT_NE(outcome.out.find("no Embree"), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.out.find("libglm-dev"), std::string::npos) << outcome.out;
}

TEST_F(Scripts, SetupInstallsWhatIsMissingAndSaysWhenThatFails) {
    stand_in("tools/sudo", "exec \"$@\"");
    stand_in("tools/dpkg-query", "case \"$*\" in *libglm-dev*) ;; *) echo install ok installed;; esac");
    stand_in("tools/apt-get", "echo \"apt-get $*\" >&2; [ \"$1\" = update ]");
    const tests::Outcome outcome = call("scripts/setup");
    EXPECT_EQ(outcome.code, 1);
    EXPECT_NE(outcome.out.find("Installing: libglm-dev\n"), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.out.find("apt-get install -y --no-install-recommends libglm-dev\n"), std::string::npos);
    EXPECT_NE(outcome.out.find("apt-get failed"), std::string::npos) << outcome.out;
}

class BundleScript : public Scripts {
protected:
    void SetUp() override {
        Scripts::SetUp();
        stand_in("root/build/release/bin/stadium", "");
        stand_in("tools/strip", "cp \"$3\" \"$2\"");
        stand_in("tools/ldd",
                 "echo 'libc.so.6 => /lib/libc.so.6 (0x1)'; echo \"own.so => " + (directory_ / "own.so") + "\"");
        for (const std::string tool : {"awk", "cp", "find", "mv", "sort", "xargs"})
            fs::create_symlink("/usr/bin/" + tool, directory_ / ("tools/" + tool));
        stand_in("tools/tar", "cd \"$2\" && find bin lib -type f >\"$4\"");
    }
};

TEST_F(BundleScript, PacksProgramsAndTheirLibrariesButNotTheSystems) {
    stand_in("own.so", "");
    const tests::Outcome outcome = call("scripts/bundle", "packed");
    EXPECT_EQ(outcome.code, 0) << outcome.out;
    EXPECT_EQ(tests::read_file(directory_ / "elsewhere/packed"), "bin/stadium\nlib/own.so\n");
}

TEST_F(BundleScript, LeavesNothingWhereSomethingIsMissing) {
    EXPECT_NE(call("scripts/bundle", "packed stadium nonesuch").code, 0);
    EXPECT_NE(call("scripts/bundle", "packed").code, 0) << "a library is missing";
    EXPECT_EQ(call("scripts/bundle").code, 2);
    EXPECT_TRUE(fs::is_empty(directory_ / "elsewhere"));
}

// What is only tested with is neither installed nor built for a picture.
class ScriptsWithoutGoogleTest : public Scripts {
protected:
    void SetUp() override {
        Scripts::SetUp();
        stand_in("tools/sudo", "exec \"$@\"");
        stand_in("tools/dpkg-query", "case \"$*\" in *libgtest-dev*|*xvfb*) ;; *) echo install ok installed;; esac");
        stand_in("tools/apt-get", "exit 0");
        stand_in("tools/apt-cache", "exit 100");
        stand_in("tools/pkg-config", "exit 1");
        stand_in("tools/cmake", "echo \"cmake $*\" >>" + (directory_ / "built"));
    }
};

TEST_F(ScriptsWithoutGoogleTest, SetupBuildsTheStadiumAlone) {
    const tests::Outcome outcome = call("scripts/setup");
    EXPECT_EQ(outcome.code, 0) << outcome.out;
    EXPECT_EQ(outcome.out.find("Installing"), std::string::npos) << outcome.out;
    EXPECT_EQ(tests::read_file(directory_ / "built"),
              "cmake --preset release\ncmake --build --preset release --target stadium\n");
}

TEST_F(ScriptsWithoutGoogleTest, SetupForTestsInstallsItAndBuildsEverything) {
    const tests::Outcome outcome = call("scripts/setup", "tests");
    EXPECT_EQ(outcome.code, 0) << outcome.out;
    EXPECT_NE(outcome.out.find("Installing: libgtest-dev xvfb\n"), std::string::npos) << outcome.out;
    EXPECT_EQ(tests::read_file(directory_ / "built"),
              "cmake --preset release -D GRANDSTAND_TESTS=ON\ncmake --build --preset release --target all\n");
}

TEST_F(ScriptsWithoutGoogleTest, BenchInstallsItBuildsTheComparisonAndPassesArgumentsOn) {
    stand_in("root/build/release/bin/front", "for argument; do echo \"[$argument]\"; done");
    const tests::Outcome outcome = call("bench", "--only 'native points'");
    EXPECT_EQ(outcome.code, 0) << outcome.out;
    EXPECT_NE(outcome.out.find("Installing: libgtest-dev\n"), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.out.find("/root/out]\n[--only]\n[native points]\n"), std::string::npos) << outcome.out;
    EXPECT_EQ(tests::read_file(directory_ / "built"),
              "cmake --preset release -D GRANDSTAND_TESTS=ON\ncmake --build --preset release --target front\n");
}

// Everything is there but chromium-driver and cage.
class ScriptsWithoutTestPrograms : public Scripts {
protected:
    void SetUp() override {
        Scripts::SetUp();
        stand_in("tools/sudo", "exec \"$@\"");
        stand_in("tools/dpkg-query", "case \"$*\" in *chromium-driver*|*cage*) ;; *) echo install ok installed;; esac");
        stand_in("tools/apt-cache", "exit 0");
        stand_in("tools/apt-get", "echo \"apt-get $*\" >&2; [ \"$1\" = update ]");
        stand_in("tools/cmake", "echo built");
        stand_in("tools/pkg-config", "exit 0");
    }
};

TEST_F(ScriptsWithoutTestPrograms, SetupInstallsNoneUnasked) {
    stand_in("tools/apt-cache", "echo looked for $*");
    const tests::Outcome outcome = call("scripts/setup");
    EXPECT_EQ(outcome.code, 0) << outcome.out;
    for (const char* program : {"chromium", "cage", "looked for"})
        EXPECT_EQ(outcome.out.find(program), std::string::npos) << outcome.out;
}

TEST_F(ScriptsWithoutTestPrograms, SetupBuildsAlsoWhereItCannotBeInstalled) {
    const tests::Outcome outcome = call("scripts/setup", "tests");
    EXPECT_EQ(outcome.code, 0) << outcome.out;
    for (const char* line : {"apt-get install -y --no-install-recommends chromium-driver\n",
                             "could not install chromium-driver: reports are not tested in a browser\n",
                             "apt-get install -y --no-install-recommends cage\n",
                             "could not install cage: the window is not tested on Wayland\n", "Building"})
        EXPECT_NE(outcome.out.find(line), std::string::npos) << line << outcome.out;
}

TEST_F(ScriptsWithoutTestPrograms, SetupBuildsAlsoWhereThereIsNoSuchPackage) {
    stand_in("tools/apt-cache", "exit 100");
    const tests::Outcome outcome = call("scripts/setup", "tests");
    EXPECT_EQ(outcome.code, 0) << outcome.out;
    EXPECT_EQ(outcome.out.find("apt-get"), std::string::npos) << outcome.out;
    for (const char* line : {"found no package chromium-driver: reports are not tested in a browser\n",
                             "found no package cage: the window is not tested on Wayland\n"})
        EXPECT_NE(outcome.out.find(line), std::string::npos) << line << outcome.out;
}

TEST_F(ScriptsWithoutTestPrograms, SetupInstallsNoCompositorForAGlfwWithoutWayland) {
    stand_in("tools/pkg-config", "exit 1");
    const tests::Outcome outcome = call("scripts/setup", "tests");
    EXPECT_EQ(outcome.code, 0) << outcome.out;
    EXPECT_NE(outcome.out.find("chromium-driver"), std::string::npos) << outcome.out;
    EXPECT_EQ(outcome.out.find("cage"), std::string::npos) << outcome.out;
}

TEST_F(Scripts, TestAsksForTestProgramsAndHandsArgumentsOn) {
    stand_in("root/scripts/setup", "echo \"setup $*\"");
    stand_in("tools/ctest", "echo \"ctest $*\"");
    stand_in("tools/nproc", "echo 3");
    const tests::Outcome outcome = call("test", "-R Selection");
    EXPECT_EQ(outcome.code, 0) << outcome.out;
    EXPECT_NE(outcome.out.find("setup tests\n"), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.out.find("--parallel 3 -R Selection\n"), std::string::npos) << outcome.out;
}

TEST_F(Scripts, DemoLeavesTheCallerInItsDirectory) {
    stand_in("root/scripts/setup", "exit 0");
    stand_in("root/build/release/bin/stadium", "echo \"in $PWD: $*\"; exit 7");
    const tests::Outcome outcome = call("demo", "--character 'a b.glb'");
    EXPECT_EQ(outcome.code, 7);
    EXPECT_NE(outcome.out.find("in " + fs::canonical(directory_ / "elsewhere").string() + ":"), std::string::npos)
        << outcome.out;
    EXPECT_NE(outcome.out.find("--character a b.glb"), std::string::npos) << outcome.out;
    EXPECT_TRUE(fs::exists(directory_ / "root/out"));
}

}  // namespace
