/* A user's program: C, nothing but the public headers. */
#include <plait/plait.h>
#include <plait/plait_backend.h>
#include <plait/plait_offline.h>
#include <plait/plait_profile.h>

#include <stdio.h>

int main(void) {
    if (plait_version() != PLAIT_VERSION_NUMBER) {
        fprintf(stderr, "the library is not that of the header\n");
        return 1;
    }
    size_t count = 0;
    if (plait_devices_list(NULL, &count) != PLAIT_OK) {
        fprintf(stderr, "%s\n", plait_last_error());
        return 1;
    }
    printf("plait %u, %zu devices\n", (unsigned)plait_version(), count);
    return count > 0 ? 0 : 1;
}
