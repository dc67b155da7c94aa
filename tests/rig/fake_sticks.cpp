// Simulated devices: a stick and a throttle as the kernel shows them. A script plugs them in, moves and unplugs them while
// an unmodified program runs. Needs umockdev:
//   umockdev-wrapper fake_sticks FOLDER SCRIPT PROGRAM ARGUMENTS...
// FOLDER holds descriptors as tests/hid/*.json. SCRIPT, a line each:
//   plug NAME NODE          a device of FOLDER/NAME.json appears as /dev/hidrawNODE
//   unplug NAME
//   report NAME HEX [COUNT] sends the report COUNT times, five milliseconds apart
//   start                   starts the program; devices plugged in before are there already
//   start typed             the same; `type` writes to the program's standard input, which closes when the script ends
//   until TEXT              waits until the program's output has TEXT, after the text of the `until` before
//   type TEXT               types a line, once the program has read all reports
//   interrupt               sends SIGINT, as Ctrl-C does
//   wait SECONDS
//   forever                 the lines below are repeated until the program has ended
//   run COMMAND             runs a shell command and waits for it
//   say TEXT                prints TEXT on standard error
#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <linux/hidraw.h>
#include <map>
#include <nlohmann/json.hpp>
#include <poll.h>
#include <pty.h>
#include <sstream>
#include <string>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <sys/wait.h>
#include <termios.h>
#include <umockdev.h>
#include <unistd.h>
#include <vector>

namespace {

using Bytes = std::vector<unsigned char>;

Bytes bytes_of(const std::string& hex)
{
    Bytes bytes;
    for (std::size_t i = 0; i + 1 < hex.size(); i += 2)
        bytes.push_back((unsigned char)(std::stoul(hex.substr(i, 2), nullptr, 16)));
    return bytes;
}

struct Stick {
    UMockdevTestbed* testbed = nullptr;
    std::string root; ///< of the simulated file system
    std::string name, vendor, product, serial, descriptor; ///< the descriptor is in hexadecimal
    std::string usb, hid, hidraw, node;
    unsigned major_number = 0, minor_number = 0;
    int master = -1, slave = -1;
    UMockdevIoctlBase* answers = nullptr;

    /// Answers the requests of hidraw's users (linux/hidraw.h).
    static gboolean answer(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer self)
    {
        const Stick& stick = *static_cast<const Stick*>(self);
        const gulong request = umockdev_ioctl_client_get_request(client);
        if (_IOC_TYPE(request) != 'H')
            return FALSE;
        UMockdevIoctlData* argument = umockdev_ioctl_client_get_arg(client);
        UMockdevIoctlData* data = umockdev_ioctl_data_resolve(argument, 0, _IOC_SIZE(request), nullptr);
        Bytes bytes = bytes_of(stick.descriptor);
        if (_IOC_NR(request) == 1) {
            int size = int(bytes.size());
            umockdev_ioctl_data_update(data, 0, reinterpret_cast<guint8*>(&size), sizeof size);
            umockdev_ioctl_client_complete(client, 0, 0);
        } else if (_IOC_NR(request) == 2) {
            const auto* requested = reinterpret_cast<const hidraw_report_descriptor*>(data->data);
            umockdev_ioctl_data_update(data, 4, bytes.data(), int(std::min<std::size_t>(requested->size, bytes.size())));
            umockdev_ioctl_client_complete(client, 0, 0);
        } else if (_IOC_NR(request) == 3) {
            hidraw_devinfo info{
                3, __s16(std::stoul(stick.vendor, nullptr, 16)), __s16(std::stoul(stick.product, nullptr, 16))};
            umockdev_ioctl_data_update(data, 0, reinterpret_cast<guint8*>(&info), sizeof info);
            umockdev_ioctl_client_complete(client, 0, 0);
        } else {
            umockdev_ioctl_client_complete(client, -1, 22);
        }
        if (data)
            g_object_unref(data);
        return TRUE;
    }

    void plug(int number, int generation)
    {
        // A pseudo-terminal stands in for the device: if one end closes, the other hangs up, as when a cable is pulled.
        char terminal[128];
        if (openpty(&master, &slave, terminal, nullptr, nullptr) != 0) {
            std::perror("fake_sticks: a pseudo-terminal (/dev/pts) is missing");
            std::exit(2);
        }
        termios raw;
        tcgetattr(slave, &raw);
        cfmakeraw(&raw);
        tcsetattr(slave, TCSANOW, &raw);
        fcntl(master, F_SETFD, FD_CLOEXEC);
        fcntl(slave, F_SETFD, FD_CLOEXEC);
        node = "/dev/hidraw" + std::to_string(number);
        mkdir((root + "/dev").c_str(), 0755);
        mkdir((root + "/dev/.ptymap").c_str(), 0755);
        std::string flat = terminal;
        std::replace(flat.begin(), flat.end(), '/', '_');
        unlink((root + node).c_str());
        if (symlink(terminal, (root + node).c_str()) != 0)
            std::perror("fake_sticks: symlink");
        struct stat own;
        stat(terminal, &own);
        major_number = major(own.st_rdev), minor_number = minor(own.st_rdev);
        const std::string numbers = std::to_string(major_number) + ":" + std::to_string(minor_number);
        unlink((root + "/dev/.ptymap/" + flat).c_str());
        if (symlink(numbers.c_str(), (root + "/dev/.ptymap/" + flat).c_str()) != 0)
            std::perror("fake_sticks: symlink");
        answers = umockdev_ioctl_base_new();
        g_signal_connect(answers, "handle-ioctl", G_CALLBACK(answer), this);
        umockdev_testbed_attach_ioctl(testbed, node.c_str(), answers, nullptr);

        const std::string place = "1-" + std::to_string(3 + number),
                          id = "0003:" + vendor + ":" + product + ".00" + std::to_string(10 + generation);
        usb = "/sys/devices/pci0000:00/0000:00:14.0/usb1/" + place;
        hid = usb + "/" + place + ":1.0/" + id;
        hidraw = hid + "/hidraw/hidraw" + std::to_string(number);
        const auto below_sys = [](const std::string& path) { return path.substr(4); };
        std::ostringstream all;
        all << "P: " << below_sys(hidraw) << "\nE: DEVNAME=" << node << "\nE: MAJOR=" << major_number
            << "\nE: MINOR=" << minor_number << "\nE: SUBSYSTEM=hidraw\nA: dev=" << numbers << "\\n\nL: device=../../../"
            << id << "\n\n"
            << "P: " << below_sys(hid) << "\nE: DRIVER=hid-generic\nE: HID_ID=0003:0000" << vendor << ":0000" << product
            << "\nE: HID_NAME=" << name << "\nE: HID_PHYS=usb-0000:00:14.0-3/input0\nE: HID_UNIQ=" << serial
            << "\nE: SUBSYSTEM=hid\nH: report_descriptor=" << descriptor << "\n\n"
            << "P: " << below_sys(usb) << "/" << place
            << ":1.0\nE: DEVTYPE=usb_interface\nE: DRIVER=usbhid\nE: INTERFACE=3/0/0\nE: SUBSYSTEM=usb\n"
            << "A: bInterfaceNumber=00\\n\nA: bInterfaceClass=03\\n\n\n"
            << "P: " << below_sys(usb) << "\nN: bus/usb/001/" << 100 + generation << "=00\nE: DEVNAME=/dev/bus/usb/001/"
            << 100 + generation << "\nE: DEVTYPE=usb_device\nE: PRODUCT=" << vendor << "/" << product
            << "/100\nE: SUBSYSTEM=usb\nE: BUSNUM=001\nE: DEVNUM=" << 100 + generation << "\nA: idVendor=" << vendor
            << "\\n\nA: idProduct=" << product << "\\n\nA: bcdDevice=0100\\n\nA: manufacturer=Rig\\n\nA: product=" << name
            << "\\n\nA: serial=" << serial << "\\n\n\n";
        GError* error = nullptr;
        if (!umockdev_testbed_add_from_string(testbed, all.str().c_str(), &error)) {
            std::fprintf(stderr, "fake_sticks: %s\n", error->message);
            std::exit(2);
        }
        umockdev_testbed_uevent(testbed, hidraw.c_str(), "add"); // again, because its parents exist only now
    }

    void unplug()
    {
        umockdev_testbed_uevent(testbed, hidraw.c_str(), "remove");
        const std::string interface = usb + "/" + usb.substr(usb.rfind('/') + 1) + ":1.0";
        for (const std::string& path : {hidraw, hid, interface, usb}) // children before their parents
            umockdev_testbed_remove_device(testbed, path.c_str());
        unlink((root + "/sys/dev/char/" + std::to_string(major_number) + ":" + std::to_string(minor_number)).c_str());
        unlink((root + "/dev/.node/" + node.substr(5)).c_str());
        unlink((root + node).c_str());
        umockdev_testbed_detach_ioctl(testbed, node.c_str(), nullptr);
        g_object_unref(answers);
        answers = nullptr;
        close(slave);
        close(master);
        master = slave = -1;
    }

    /// Waits until the number of bytes that the program has still to read is right, at most so many tenths of a
    /// millisecond.
    template <class Right> void wait_until(Right right, int most) const
    {
        for (int i = 0; i < most; ++i) {
            int waiting = 0;
            ioctl(slave, FIONREAD, &waiting);
            if (right(waiting))
                break;
            usleep(100);
        }
    }

    /// Waits until the program has read everything that was written. A busy machine's frame may take seconds.
    void drain() const
    {
        wait_until([](int waiting) { return waiting == 0; }, 50'000);
    }

    /// Sends one report for each read, because a terminal would join two waiting ones.
    void report(const Bytes& bytes)
    {
        drain();
        if (write(master, bytes.data(), bytes.size()) != ssize_t(bytes.size()))
            std::perror("fake_sticks: write");
        wait_until([](int waiting) { return waiting > 0; }, 500); // the kernel's worker hands it on; or it is read already
    }
};

/// True once the program has ended; a report would have no reader then.
bool has_ended(pid_t program)
{
    siginfo_t info{};
    return program > 0 && waitid(P_PID, id_t(program), &info, WEXITED | WNOHANG | WNOWAIT) == 0 && info.si_pid == program;
}

/// The program's standard input and output, for scripts with `start typed`.
struct Dialogue {
    int keyboard = -1, screen = -1;
    std::string said;
    std::size_t matched = 0; ///< end of the text in `said` that `until` has already found

    /// Copies the program's output for at most wait_ms. Returns false when the output has ended.
    bool listen(int wait_ms)
    {
        char bytes[4096];
        pollfd wait{screen, POLLIN, 0};
        if (poll(&wait, 1, wait_ms) <= 0)
            return true;
        const ssize_t count = read(screen, bytes, sizeof bytes);
        if (count <= 0)
            return false;
        said.append(bytes, std::size_t(count));
        return write(1, bytes, std::size_t(count)) == count;
    }

    bool until(const std::string& text)
    {
        for (int i = 0; i < 1000; ++i) {
            if (const auto at = said.find(text, matched); at != said.npos) {
                matched = at + text.size();
                return true;
            }
            if (!listen(10))
                break;
        }
        std::fprintf(stderr, "fake_sticks: the program's output lacks: %s\n", text.c_str());
        return false;
    }

    void end()
    {
        if (keyboard < 0)
            return;
        close(keyboard);
        while (listen(-1)) { }
    }
};

} // namespace

int main(int count, char** arguments)
{
    if (count < 4)
        return 2;
    UMockdevTestbed* testbed = umockdev_testbed_new();
    char* root_text = umockdev_testbed_get_root_dir(testbed);
    const std::string root = root_text, folder = arguments[1];
    g_free(root_text);
    std::map<std::string, Stick> sticks;
    int generation = 0;
    std::ifstream script(arguments[2]);
    pid_t program = -1;
    Dialogue dialogue;
    std::signal(SIGPIPE, SIG_IGN); // the program may end while the script still types
    std::streampos again = -1;
    for (std::string line; std::getline(script, line) || (again != -1 && !has_ended(program));) {
        if (!script) {
            script.clear();
            script.seekg(again);
            continue;
        }
        std::istringstream words(line);
        std::string verb, name, rest;
        words >> verb;
        if (verb == "start") {
            int in[2], out[2];
            const bool typed = words >> rest && rest == "typed" && pipe2(in, O_CLOEXEC) == 0 && pipe2(out, O_CLOEXEC) == 0;
            program = fork();
            if (program == 0) {
                std::signal(SIGPIPE, SIG_DFL);
                if (typed) {
                    dup2(in[0], 0);
                    dup2(out[1], 1);
                }
                execvp(arguments[3], arguments + 3);
                _exit(127);
            }
            if (typed) {
                dialogue.keyboard = in[1], dialogue.screen = out[0];
                close(in[0]);
                close(out[1]);
            }
        } else if (verb == "until") {
            std::getline(words >> std::ws, rest);
            if (!dialogue.until(rest))
                break; // the program ends when its input closes
        } else if (verb == "type") {
            std::getline(words >> std::ws, rest);
            for (const auto& [key, stick] : sticks)
                if (stick.slave >= 0)
                    stick.drain();
            usleep(20000); // time from the read of a report to its evaluation
            rest += '\n';
            (void)!write(dialogue.keyboard, rest.data(), rest.size());
        } else if (verb == "forever") {
            again = script.tellg();
        } else if (verb == "interrupt") {
            kill(program, SIGINT);
        } else if (verb == "plug") {
            int node = 0;
            words >> name >> node;
            const auto file = nlohmann::json::parse(std::ifstream(folder + "/" + name + ".json"));
            Stick& stick = sticks[name];
            stick.testbed = testbed, stick.root = root;
            stick.name = file["name"], stick.vendor = file["vid"], stick.product = file["pid"],
            stick.serial = file.value("serial", ""), stick.descriptor = file["descriptor_hex"];
            stick.plug(node, generation++);
        } else if (verb == "unplug") {
            words >> name;
            sticks.at(name).unplug();
        } else if (verb == "report") {
            int times = 1;
            words >> name >> rest >> times;
            for (int i = 0; i < std::max(times, 1) && !has_ended(program); ++i) {
                sticks.at(name).report(bytes_of(rest));
                usleep(5000);
            }
        } else if (verb == "wait") {
            double seconds = 0;
            words >> seconds;
            usleep(useconds_t(seconds * 1e6));
        } else if (verb == "run") {
            std::getline(words, rest);
            if (std::system(rest.c_str()) != 0)
                std::fprintf(stderr, "rig: failed:%s\n", rest.c_str());
        } else if (verb == "say") {
            std::getline(words, rest);
            std::fprintf(stderr, "rig:%s\n", rest.c_str());
        }
    }
    dialogue.end();
    int status = 0;
    if (program > 0)
        waitpid(program, &status, 0);
    g_object_unref(testbed);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}
