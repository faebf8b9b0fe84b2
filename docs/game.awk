# The log of a game that never ran, as PresentMon 2 writes them: a minute on a display of 144 Hz with variable refresh.
# The GPU sets the pace; a crowded place is the CPU's; in a menu frames come faster than they can be shown, and some are
# dropped; new places compile shaders.
# docs/game.png is of its page:
#   awk -f docs/game.awk > night-drive.csv
#   replay night-drive.csv --report night-drive.html
#   chromium --headless --hide-scrollbars --window-size=1280,2190 --screenshot=docs/game.png night-drive.html

function uniform() {  # Park and Miller's generator: the same on every machine
    seed = seed * 16807 % 2147483647
    return seed / 2147483647
}
function between(low, high) { return low + (high - low) * uniform() }
function noise(size) { return size * (uniform() + uniform() + uniform() - 1.5) }
function most(a, b) { return a > b ? a : b }

function row(time, until) {
    shown = until == "NA" ? "NA,NA,NA" : sprintf("%.4f,%.4f,%s", ready - start, until - display, error)
    printf "NightDrive.exe,4242,0xA0,DXGI,0,0,1,Hardware: Independent Flip,Application,%.4f,%.4f,%.4f,%.4f,%.4f,%.4f,%.4f,%s,%d\n",
        start, time, cpu, time - cpu, gpu + 0.2, gpu, time - gpu, shown, compiled
}

BEGIN {
    seed = 20261127
    print "Application,ProcessID,SwapChainAddress,PresentRuntime,SyncInterval,PresentFlags,AllowsTearing,PresentMode,FrameType,CPUStartTime,FrameTime,CPUBusy,CPUWait,GPUTime,GPUBusy,GPUWait,DisplayLatency,DisplayedTime,AnimationError,PsoCompileCount"
    refresh = 1000 / 144
    for (start = 0; start < 60000; start += time) {
        second = start / 1000
        gpu = 10.2 + 1.4 * sin(second / 3.1) + 0.8 * sin(second / 0.9) + noise(0.7)
        cpu = 6.5 + 0.8 * sin(second / 2.3) + noise(0.6)
        if (second > 22 && second < 33) {  # a market square
            cpu += 7.5 * sin((second - 22) / 11 * 3.14159)
            gpu -= 1.5
        }
        if (second > 45 && second < 50) {  # a menu
            gpu = 4.6 + noise(0.9)
            cpu = 2.6 + noise(0.4)
        }
        compiled = 0
        place = int(second)
        is_new = place == 6 || place == 14 || place == 34 || place == 35 || place == 52
        if (is_new && uniform() < 0.03) {
            compiled = 1 + int(between(0, 6))
            cpu += compiled * between(7, 16)
        }
        if (uniform() < 0.0006) gpu += between(22, 40)  # textures that didn't fit
        time = most(cpu + 0.15, gpu + between(0.05, 0.2))
        # Shown when it is ready and the display has done with the last; never, if the next is ready before that.
        ready = start + cpu + gpu * 0.6
        if (count > 0 && ready + time < display + refresh) {
            row(time, "NA")
            continue
        }
        next_display = most(ready, display + refresh)
        error = count > 0 ? sprintf("%.4f", start - last_start - (next_display - display)) : "NA"
        if (count == 0) display = next_display - time
        row(time, next_display)
        display = next_display
        last_start = start
        ++count
    }
}
