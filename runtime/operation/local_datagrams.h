#pragma once
#include <string>

namespace starbow {

/// A socket that sends datagrams to a service of this machine, as the service manager and the journal are. It never waits.
class LocalDatagrams {
public:
    /// name: the path of the service's socket, or "@" and an abstract name. Nothing is sent where it is null or of another
    /// form, or where nobody listens there.
    explicit LocalDatagrams(const char* name);
    ~LocalDatagrams();
    LocalDatagrams(const LocalDatagrams&) = delete;

    bool connected() const { return socket_ >= 0; }
    /// Returns false where the service does not take the message at once: it is full, away or restarted.
    bool send(const std::string& message) const;

private:
    int socket_;
};

} // namespace starbow
