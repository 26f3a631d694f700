/* Runs a client in the fork server of `server.py`: stub SOCKET SCRIPT ARGUMENT ...

   Passes its arguments and its standard files to the server, and ends with the exit status of the client. If this
   program is killed, its connection closes, and the server kills the client. */

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

int main(int count, char **words) {
    static char text[1 << 15];
    size_t length = 0;
    for (int k = 2; k < count; k++) {
        size_t size = strlen(words[k]) + 1;
        if (length + size > sizeof text) return 125;
        memcpy(text + length, words[k], size);
        length += size;
    }
    struct sockaddr_un address = {.sun_family = AF_UNIX};
    if (count < 3 || strlen(words[1]) >= sizeof address.sun_path) return 125;
    strcpy(address.sun_path, words[1]);
    int server = socket(AF_UNIX, SOCK_STREAM, 0);
    if (server < 0 || connect(server, (struct sockaddr *)&address, sizeof address)) {
        perror("stub");
        return 125;
    }
    union { struct cmsghdr head; char room[CMSG_SPACE(3 * sizeof(int))]; } control = {{0}};
    struct iovec part = {text, length};
    struct msghdr message = {.msg_iov = &part, .msg_iovlen = 1, .msg_control = &control,
                             .msg_controllen = sizeof control.room};
    struct cmsghdr *head = CMSG_FIRSTHDR(&message);
    int files[3] = {0, 1, 2};
    head->cmsg_level = SOL_SOCKET, head->cmsg_type = SCM_RIGHTS, head->cmsg_len = CMSG_LEN(sizeof files);
    memcpy(CMSG_DATA(head), files, sizeof files);
    if (sendmsg(server, &message, 0) != (ssize_t)length) return 125;
    /* The client alone holds the files from here on: the reader of its output must find the end when it ends. */
    for (int file = 0; file < 3; file++) close(file);
    unsigned char status;
    return read(server, &status, 1) == 1 ? status : 125;
}
