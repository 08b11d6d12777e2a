/* Links plait, and asks it for its version. */
#include <plait/plait.h>

#include <stdio.h>

int main(void) {
    printf("plait %u\n", (unsigned)plait_version());
    return plait_version() == PLAIT_VERSION_NUMBER ? 0 : 1;
}
