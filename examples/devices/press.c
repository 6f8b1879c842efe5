/* A device for Palpa without hardware: presses into the body and prints the force.
 *
 *   cc -std=c99 -O2 -o press press.c -lm
 *   palpa-cli serve projects/sphere.json --socket /tmp/palpa.sock &
 *   ./press /tmp/palpa.sock 0 0 25  0 0 -2
 *
 * Moves a handle from outside of the body to the place, on along the displacement at 20 mm/s, rests
 * there for a second, and goes back. Replace the positions by the encoders of your device and apply
 * each force to its motors. The protocol is described in docs/device-protocol.md.
 *
 * C99 and POSIX, for little-endian machines.
 */
#define _POSIX_C_SOURCE 200809L
#include <errno.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <time.h>
#include <unistd.h>

enum { kHello = 1, kWelcome = 2, kPosition = 3, kForce = 4, kError = 5 };
enum { kSize = 64, kErrorSize = 256 };

typedef struct {
  double force[3];  /* N, on the hand */
  uint32_t status;  /* bits: docs/device-protocol.md */
  double stiffness; /* N/mm */
} Answer;

static void fail(const char* what) {
  fprintf(stderr, "press: %s\n", what);
  exit(1);
}

static void begin(unsigned char* message, uint16_t type) {
  const uint16_t size = kSize;
  memset(message, 0, kSize);
  memcpy(message, "PALP", 4);
  memcpy(message + 4, &type, 2);
  memcpy(message + 6, &size, 2);
}

static void sendAll(int connection, const unsigned char* bytes, size_t count) {
  while (count > 0) {
    const ssize_t sent = send(connection, bytes, count, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    /* The reason can still be read. */
    if (sent < 0) return;
    bytes += sent;
    count -= (size_t)sent;
  }
}

static void receiveAll(int connection, unsigned char* bytes, size_t count) {
  while (count > 0) {
    const ssize_t got = recv(connection, bytes, count, 0);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) fail("Palpa closed the connection");
    bytes += got;
    count -= (size_t)got;
  }
}

/* Reads a message of the expected type; ends the program with the text of an error. */
static void receive(int connection, unsigned char* message, uint16_t expected) {
  uint16_t type = 0, size = 0;
  receiveAll(connection, message, 8);
  memcpy(&type, message + 4, 2);
  memcpy(&size, message + 6, 2);
  if (memcmp(message, "PALP", 4) != 0 || size < 8 || size > kErrorSize) fail("this is not Palpa");
  receiveAll(connection, message + 8, (size_t)size - 8);
  if (type == kError) {
    message[kErrorSize - 1] = 0;
    fail((const char*)message + 16);
  }
  if (type != expected) fail("unexpected message");
}

static void greet(int connection) {
  unsigned char message[kErrorSize];
  const uint16_t version = 1;
  const double stiffness = 1e6; /* a program renders any stiffness */
  begin(message, kHello);
  memcpy(message + 8, &version, 2);
  memcpy(message + 10, &version, 2);
  /* No workspace (16 to 39): positions are in the coordinates of the project. Any force (40). */
  memcpy(message + 48, &stiffness, 8);
  sendAll(connection, message, kSize);
  receive(connection, message, kWelcome);
}

static Answer ask(int connection, uint64_t sequence, const double position[3]) {
  unsigned char message[kErrorSize];
  uint64_t answered = 0;
  struct timespec now;
  double time;
  Answer answer;
  clock_gettime(CLOCK_MONOTONIC, &now);
  time = (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
  begin(message, kPosition);
  memcpy(message + 8, &sequence, 8);
  memcpy(message + 16, position, 24);
  memcpy(message + 48, &time, 8);
  sendAll(connection, message, kSize);
  receive(connection, message, kForce);
  memcpy(&answered, message + 8, 8);
  if (answered != sequence) fail("the force belongs to another position");
  memcpy(answer.force, message + 16, 24);
  memcpy(&answer.status, message + 40, 4);
  memcpy(&answer.stiffness, message + 48, 8);
  return answer;
}

/* Sleeps until the next millisecond. */
static void waitForNext(struct timespec* due) {
  due->tv_nsec += 1000000;
  if (due->tv_nsec >= 1000000000) {
    due->tv_nsec -= 1000000000;
    ++due->tv_sec;
  }
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, due, NULL) == EINTR) {
  }
}

int main(int argc, char** argv) {
  const double start = -1, step = 0.02; /* mm along the direction; 20 mm/s */
  struct sockaddr_un address;
  struct timespec due;
  double at[3], direction[3], depth = 0, distance = start;
  uint64_t sequence = 0;
  int phase = 0, resting = 0, k;
  Answer answer, deepest;
  const int connection = socket(AF_UNIX, SOCK_STREAM, 0);
  if (argc != 8) fail("usage: press SOCKET X Y Z DX DY DZ   (place and displacement in mm)");
  for (k = 0; k < 3; ++k) {
    at[k] = atof(argv[2 + k]);
    direction[k] = atof(argv[5 + k]);
    depth += direction[k] * direction[k];
  }
  depth = sqrt(depth);
  if (!(depth > 0)) fail("the displacement must not be zero");
  for (k = 0; k < 3; ++k) direction[k] /= depth;
  memset(&address, 0, sizeof address);
  address.sun_family = AF_UNIX;
  if (strlen(argv[1]) >= sizeof address.sun_path) fail("the path of the socket is too long");
  strcpy(address.sun_path, argv[1]);
  if (connect(connection, (const struct sockaddr*)&address, sizeof address) != 0)
    fail(strerror(errno));
  greet(connection);

  memset(&deepest, 0, sizeof deepest);
  clock_gettime(CLOCK_MONOTONIC, &due);
  /* 0: wait until the place is computed; 1: in; 2: rest; 3: out */
  while (phase < 4) {
    double position[3];
    for (k = 0; k < 3; ++k) position[k] = at[k] + distance * direction[k];
    answer = ask(connection, ++sequence, position);
    waitForNext(&due);
    if (phase == 0) {
      if (answer.stiffness > 0) phase = 1;
    } else if (phase == 1) {
      distance = fmin(depth, distance + step);
      if (distance == depth) phase = 2;
    } else if (phase == 2) {
      deepest = answer;
      if (++resting == 1000) phase = 3;
    } else {
      distance -= step;
      if (distance < start) phase = 4;
    }
  }
  close(connection);
  printf("{\"force_N\": [%.6g, %.6g, %.6g], \"touching\": %s, \"stiffness_N_per_mm\": %.6g}\n",
         deepest.force[0], deepest.force[1], deepest.force[2],
         (deepest.status & 1) != 0 ? "true" : "false", deepest.stiffness);
  return 0;
}
