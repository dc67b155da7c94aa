"""load_test.sh starts this: load.py REMOTE_STAGE EXHIBIT.json PAIRS. Phases of five seconds without and with 200 pages follow each
other in one run of the stage, so that both see the same noise of the machine."""
import select
import signal
import socket
import subprocess
import sys
import time

PAGES, PHASE_S, COMMANDS_PER_S, PORT = 200, 5.0, 20, 18090
HOST = f"127.0.0.1:{PORT}"


def connection(request):
    wire = socket.create_connection(("127.0.0.1", PORT), timeout=10)
    wire.sendall(request.encode())
    head = b""
    while not head.endswith(b"\r\n\r\n"):
        head += wire.recv(1)
    return wire, head.decode()


def log_in(pin="222222"):
    body = f'{{"pin":"{pin}"}}'
    wire, head = connection(f"POST /login HTTP/1.1\r\nHost: {HOST}\r\nOrigin: http://{HOST}\r\nContent-Length: {len(body)}\r\n\r\n{body}")
    wire.close()
    return head.split("set-cookie: ")[1].split(";")[0]


def open_page(cookie):
    wire, head = connection(f"GET / HTTP/1.1\r\nHost: {HOST}\r\nOrigin: http://{HOST}\r\nCookie: {cookie}\r\nConnection: Upgrade\r\n"
                            "Upgrade: websocket\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n"
                            "Sec-WebSocket-Protocol: starbow\r\n\r\n")
    assert " 101 " in head, head
    wire.setblocking(False)
    return wire


def frame(text):
    data = text.encode()
    head = bytes([0x81, 0x80 | len(data)]) if len(data) < 126 else bytes([0x81, 0x80 | 126, len(data) >> 8, len(data) & 255])
    return head + b"\0\0\0\0" + data


def phase(pages, seconds):
    """Reads for some seconds; returns states a second and page."""
    poll = select.epoll()
    by_number = {page.fileno(): page for page in pages}
    for number in by_number:
        poll.register(number, select.EPOLLIN)
    end, next_command, states, turn = time.monotonic() + seconds, 0.0, 0, 0
    while (now := time.monotonic()) < end:
        if pages and now >= next_command:
            next_command = now + 1 / COMMANDS_PER_S
            turn += 1
            pages[turn % len(pages)].sendall(frame(f'{{"id":{turn},"command":["caption","sent {time.monotonic_ns()}"]}}'))
        for number, _ in poll.poll(min(0.01, end - now)):
            data = by_number[number].recv(65536)
            assert data, "a page was disconnected"
            states += data.count(b'{"status"')
    poll.close()
    return states / seconds / max(1, len(pages))


def percentiles(stage):
    """{name: (p50, p99, greatest)} of the frames since the last call."""
    stage.send_signal(signal.SIGUSR1)
    found = {}
    for line in stage.stdout:
        if line == "end\n":
            return found
        name, *values = line.split()
        found[name] = tuple(float(value) for value in values[:3])


def main():
    program, exhibit, pairs = sys.argv[1:]
    stage = subprocess.Popen([program, exhibit, "10"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    while not stage.stdout.readline().startswith("page"):
        pass
    time.sleep(1)
    cookie, ratios, commands = log_in(), {"wall_ms": [], "processor_ms": []}, []
    print("pages  states/s  frame wall p50, p99  processor p50, p99  command to frame p50, p99, greatest (ms)")
    for _ in range(int(pairs)):
        p99 = {}
        for count in (0, PAGES):
            pages = [open_page(cookie) for _ in range(count)]
            phase(pages, 0.5)
            percentiles(stage)
            rate = phase(pages, PHASE_S)
            found = percentiles(stage)
            for page in pages:
                page.close()
            time.sleep(0.5)
            p99[count] = {name: found[name][1] for name in ratios}
            command = found.get("command_ms")
            commands += [command] if command else []
            print(f"{count:5} {rate:9.2f}  {found['wall_ms'][0]:9.3f} {found['wall_ms'][1]:9.3f}  {found['processor_ms'][0]:9.3f} "
                  f"{found['processor_ms'][1]:9.3f}  " + (" ".join(f"{value:.2f}" for value in command) if command else "-"), flush=True)
        for name in ratios:
            ratios[name].append(p99[PAGES][name] / p99[0][name])
    stage.terminate()
    for name, values in ratios.items():
        values.sort()
        print(f"{name}: p99 with {PAGES} pages / p99 without: median {values[len(values) // 2]:.4f}, {values[0]:.4f} to {values[-1]:.4f}")
    p99s = sorted(one[1] for one in commands)
    print(f"command to frame: p99 of the phases: median {p99s[len(p99s) // 2]:.2f} ms, {p99s[0]:.2f} to {p99s[-1]:.2f}; a frame comes every "
          "16.67 ms, and the command is in its picture")


if __name__ == "__main__":
    main()
