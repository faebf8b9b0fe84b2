// Recordings as the tools write them, made by the tests.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "sfsm/recordings/recording.h"

namespace sfsm {

struct Table {
    std::vector<std::string> preamble;  // lines before the header
    std::vector<std::string> columns;
    std::vector<std::vector<std::string>> rows;
    std::string separator = ",", line_end = "\n";

    std::string line(const std::vector<std::string>& fields) const {
        std::string text;
        for (std::size_t i = 0; i < fields.size(); ++i) text += (i == 0 ? "" : separator) + fields[i];
        return text + line_end;
    }
    std::string text() const {
        std::string text;
        for (const std::string& before : preamble) text += before + line_end;
        text += line(columns);
        for (const std::vector<std::string>& row : rows) text += line(row);
        return text;
    }
};

inline Recording read(const std::string& text, const RecordingOptions& options = {}) {
    std::istringstream in(text);
    return read_recording(in, "r.csv", options);
}

// What a refused recording is refused with; "" and a failure if it isn't.
inline std::string refusal(const std::string& text, const RecordingOptions& options = {}) {
    try {
        read(text, options);
        ADD_FAILURE() << "read: " << text.substr(0, 200);
        return "";
    } catch (const std::runtime_error& error) {
        const std::string message = error.what();
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
        EXPECT_TRUE(message.starts_with("r.csv:")) << message;
        return message;
    }
}

inline std::vector<double> frame_times(const Recording& recording) {
    std::vector<double> times;
    for (const FrameRecord& frame : recording.frames) times.push_back(frame.frame_ms);
    return times;
}

inline bool has_note(const Recording& recording, const std::string& text) {
    for (const std::string& note : recording.notes) {
        if (note.find(text) != std::string::npos) return true;
    }
    return false;
}

inline bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

// Three frames of one application in every format but MangoHud's and FRAPS's.
inline Table presentmon_1() {
    Table table;
    table.columns = {"Application",   "ProcessID",         "SwapChainAddress",       "Runtime",    "Dropped",
                     "TimeInSeconds", "msBetweenPresents", "msBetweenDisplayChange", "msGPUActive"};
    table.rows = {{"a.exe", "12", "0xA0", "DXGI", "0", "0.0160", "16.1", "16.6", "3.1"},
                  {"a.exe", "12", "0xA0", "DXGI", "1", "0.0322", "16.2", "0.00", "3.2"},
                  {"a.exe", "12", "0xA0", "DXGI", "0", "0.0485", "16.3", "33.3", "3.3"}};
    return table;
}

inline Table presentmon_2() {
    Table table;
    table.columns = {"Application", "ProcessID", "SwapChainAddress", "FrameType",    "CPUStartTime",
                     "FrameTime",   "CPUBusy",   "GPUBusy",          "DisplayedTime"};
    table.rows = {{"a.exe", "12", "0xA0", "Application", "0.10", "16.1", "5.1", "3.1", "16.6"},
                  {"a.exe", "12", "0xA0", "Application", "16.2", "16.2", "5.2", "3.2", "NA"},
                  {"a.exe", "12", "0xA0", "Application", "32.4", "16.3", "5.3", "3.3", "33.3"}};
    return table;
}

inline Table presentmon_current() {
    Table table;
    table.columns = {"Application", "ProcessID",         "SwapChainAddress", "PresentRuntime", "FrameType",
                     "TimeInMs",    "MsBetweenPresents", "MsUntilDisplayed", "MsCPUBusy",      "MsGPUBusy"};
    table.rows = {{"a.exe", "12", "0xA0", "DXGI", "Application", "16.1", "16.1", "20.1", "5.1", "3.1"},
                  {"a.exe", "12", "0xA0", "DXGI", "Application", "32.3", "16.2", "NA", "5.2", "3.2"},
                  {"a.exe", "12", "0xA0", "DXGI", "Application", "48.6", "16.3", "20.3", "5.3", "3.3"}};
    return table;
}

inline Table mangohud() {
    Table table;
    table.preamble = {"os,cpu,gpu,ram,kernel,driver,cpuscheduler", "Arch,Ryzen 7,RX 6800,32000,6.1,radv,schedutil"};
    table.columns = {"fps", "frametime", "cpu_load", "gpu_load", "elapsed"};
    table.rows = {{"62.1", "16.1", "20", "90", "16100000"},
                  {"61.7", "16.2", "21", "91", "32300000"},
                  {"61.3", "16.3", "22", "92", "48600000"}};
    return table;
}

inline Table fraps() {
    Table table;
    table.columns = {"Frame", " Time (ms)"};
    table.rows = {{"    1", "     0.000"}, {"    2", "    16.100"}, {"    3", "    32.300"}, {"    4", "    48.600"}};
    return table;
}

// As Afterburner writes them, a row a second; `frametimes` in milliseconds.
inline std::string afterburner(const std::vector<std::string>& frametimes) {
    const std::string day = ", 01-01-2026 00:00:0";
    std::string text = "00" + day + "0, Hardware monitoring log v1.6 \n01" + day + "0, GeForce RTX\n02" + day +
                       "0, GPU usage           ,Framerate           ,Frametime           \n03" + day +
                       "0, 0                   ,100                 ,                    \n";
    for (std::size_t i = 0; i < frametimes.size(); ++i) {
        text += "80" + day + std::to_string(i % 10) + ", 95.000              ,60.000              ," + frametimes[i] +
                "              \n";
    }
    return text;
}

inline std::string unreal(const std::vector<std::string>& frametimes) {
    const std::string header = "EVENTS,FrameTime,GameThreadTime,RenderThreadTime,GPUTime\n";
    std::string text = header;
    for (const std::string& ms : frametimes) text += "," + ms + ",5.1,4.2,3.1\n";
    return text + header + "[HasHeaderRowAtEnd],1,[Platform],Windows,[Commandline],\"C:\\Users\\x\"\n";
}

}  // namespace sfsm
