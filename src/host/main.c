/* main.c: the command "cage": finds the subcommand in a table and runs it. */
#include <string.h>

#include "parts.h"

typedef struct command {
    const char *name;
    const char *purpose;
    int (*run)(int argc, char **argv); /* argv[0] is the name */
    void (*help)(FILE *out);
} command;

static const command commands[] = {
    { "prove", "prove that an object cannot leave, or find its way out", host_prove, host_prove_help },
    { "atlas", "find out once how a whole scene is connected, and write it to a file", host_atlas, host_atlas_help },
    { "query", "ask such a file about poses", host_query_command, host_query_help },
};

static const size_t command_count = sizeof commands / sizeof commands[0];

static void print_help(FILE *out)
{
    size_t i;

    (void)fprintf(out, "cage: prove that a rigid object made of balls cannot leave, or find its way out.\n"
                       "\n"
                       "usage: cage COMMAND [OPTIONS]\n"
                       "       cage COMMAND --help\n"
                       "       cage --help | --version\n"
                       "\n"
                       "commands:\n");
    for (i = 0; i < command_count; i++)
        (void)fprintf(out, "  %-8s %s\n", commands[i].name, commands[i].purpose);
    (void)fprintf(out, "\n"
                       "in this build:\n"
                       "  smooth paths (prove --smooth) by %s\n"
                       "  true shapes (prove --parts) by %s\n", smooth_metric_name(), host_parts_name());
}

static const command *find_command(const char *name)
{
    size_t i;

    for (i = 0; i < command_count; i++)
        if (strcmp(name, commands[i].name) == 0)
            return &commands[i];
    return NULL;
}

/* Installed as "cage-prove", the program is its command. */
static const command *own_command(const char *program)
{
    const char *slash = strrchr(program, '/'), *base = slash != NULL ? slash + 1 : program;

    return strncmp(base, "cage-", 5) == 0 ? find_command(base + 5) : NULL;
}

static int wants_help(int argc, char **argv)
{
    int i;

    for (i = 1; i < argc; i++)
        if (strcmp(argv[i], "--help") == 0 || strcmp(argv[i], "-h") == 0)
            return 1;
    return 0;
}

/* Standard output may be a full disk: then nothing was answered. */
static int finish(int code)
{
    if (fflush(stdout) != 0 || ferror(stdout)) {
        (void)fprintf(stderr, "cage: standard output cannot be written\n");
        return code == HOST_OK ? HOST_BAD_INPUT : code;
    }
    return code;
}

int main(int argc, char **argv)
{
    const char *name = argc > 1 ? argv[1] : "";
    const command *chosen = find_command(name);
    int skipped = chosen != NULL; /* arguments before the command's own name */

    if (chosen == NULL && argc > 0)
        chosen = own_command(argv[0]);
    if (strcmp(name, "--version") == 0) {
        (void)printf("cage %s\n", CAGE_VERSION);
        return finish(HOST_OK);
    }
    if (wants_help(argc, argv)) {
        (chosen != NULL ? chosen->help : print_help)(stdout);
        return finish(HOST_OK);
    }
    if (chosen != NULL)
        return finish(chosen->run(argc - skipped, argv + skipped));
    if (argc > 1)
        (void)fprintf(stderr, "cage: '%.100s' is not a command\n\n", name);
    print_help(stderr);
    return HOST_BAD_INPUT;
}
