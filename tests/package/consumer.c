/* A user's program: C, nothing but the public header. */
#include <plait/plait.h>

#include <stdio.h>

int main(void) {
    size_t count = 0;
    if (plait_devices_list(NULL, &count) != PLAIT_OK) {
        fprintf(stderr, "%s\n", plait_last_error());
        return 1;
    }
    printf("plait %u, %zu devices\n", (unsigned)plait_version(), count);
    return count > 0 ? 0 : 1;
}
