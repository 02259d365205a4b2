"""A client of HTTP/2 with Python's standard library alone, which can stop at any byte, as a hostile one does."""
import socket
import struct
import threading


class Http2:
    """A connection to the gRPC port. Reads what comes, respects the windows of the server, keeps no messages."""

    def __init__(self, port, token=None, reads=True):
        self.socket = socket.create_connection(("127.0.0.1", port))
        self.token, self.reads, self.next_id, self.ended, self.failed = token, reads, 1, {}, False
        self.window, self.windows, self.initial = 65535, {}, 65535
        self.changed = threading.Condition()
        window = b"" if reads else struct.pack(">HI", 4, 1024)
        self.socket.sendall(b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n" + self.frame(4, 0, 0, window))
        if reads:
            threading.Thread(target=self.read, daemon=True).start()

    @staticmethod
    def frame(kind, flags, stream, payload):
        return struct.pack(">I", len(payload))[1:] + struct.pack(">BBI", kind, flags, stream) + payload

    def headers(self, path):
        fields = [(":method", "POST"), (":scheme", "http"), (":path", path), (":authority", "localhost"),
                  ("te", "trailers"), ("content-type", "application/grpc")]
        if self.token:
            fields.append(("authorization", "Bearer " + self.token))
        number = lambda size: bytes([size]) if size < 127 else bytes([127, (size - 127) & 127 | 128, (size - 127) >> 7])
        return b"".join(b"\0" + number(len(name)) + name.encode() + number(len(value)) + value.encode()
                        for name, value in fields)

    def begin(self, path):
        """Opens a call; returns its stream."""
        with self.changed:
            stream, self.next_id = self.next_id, self.next_id + 2
            self.windows[stream] = self.initial
            self.socket.sendall(self.frame(1, 4, stream, self.headers(path)))
        return stream

    def send(self, stream, data, last=True):
        """Sends bytes of a call as the windows allow; false if it ended before."""
        view = memoryview(data)
        while view or last:
            with self.changed:
                free = lambda: min(self.window, self.windows.get(stream, 0), 16384)
                while view and free() <= 0 and stream not in self.ended and not self.failed:
                    if not self.changed.wait(30):
                        return False
                if stream in self.ended or self.failed:
                    return False
                part, view = view[:free()], view[free():]
                self.window -= len(part)
                self.windows[stream] -= len(part)
                ends = last and not view
                try:
                    self.socket.sendall(self.frame(0, 1 if ends else 0, stream, bytes(part)))
                except OSError:
                    return False
            if ends:
                return True
        return True

    def call(self, path, message=b"", patience=120):
        stream = self.begin(path)
        self.send(stream, b"\0" + struct.pack(">I", len(message)) + message)
        with self.changed:
            self.changed.wait_for(lambda: stream in self.ended or self.failed, patience)
        return stream in self.ended

    def read(self):
        try:
            file = self.socket.makefile("rb")
            while True:
                head = file.read(9)
                if len(head) < 9:
                    break
                size, kind, flags, stream = int.from_bytes(head[:3], "big"), head[3], head[4], head[5:]
                payload, stream = file.read(size), int.from_bytes(stream, "big")
                with self.changed:
                    self.take(kind, flags, stream, payload)
                    self.changed.notify_all()
        except OSError:
            pass
        with self.changed:
            self.failed = True
            self.changed.notify_all()

    def take(self, kind, flags, stream, payload):
        if kind == 0 and payload:
            add = struct.pack(">I", len(payload))
            self.socket.sendall(self.frame(8, 0, 0, add) + self.frame(8, 0, stream, add))
        elif kind == 4 and not flags & 1:
            for key, value in struct.iter_unpack(">HI", payload):
                if key == 4:
                    for each in self.windows:
                        self.windows[each] += value - self.initial
                    self.initial = value
            self.socket.sendall(self.frame(4, 1, 0, b""))
        elif kind == 6 and not flags & 1:
            self.socket.sendall(self.frame(6, 1, 0, payload))
        elif kind == 8:
            more = int.from_bytes(payload, "big")
            if stream == 0:
                self.window += more
            elif stream in self.windows:
                self.windows[stream] += more
        if kind == 3 or (kind in (0, 1) and flags & 1):
            self.ended[stream] = True
            self.windows.pop(stream, None)
