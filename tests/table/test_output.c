/* Output is complete or absent: full disks, missing folders, killed writers, targets that are no plain files. */
#define _XOPEN_SOURCE 700
#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include "support/suite.h"
#include "table/by_hand.h"

static const char old_text[] = "what was there before\n";

static void expect_text(const char *path, const char *text) {
    size_t length;
    char *bytes = read_bytes(path, &length);
    ck_assert_str_eq(bytes, text);
    free(bytes);
}

START_TEST(a_file_holds_what_was_written_and_nothing_stands_beside_it) {
    char folder[PATH_SIZE], path[PATH_SIZE];
    make_folder(folder);
    gough_error error = {.message = ""};
    path_in(folder, "a.txt", path);
    ck_assert_msg(gough_write_file(path, "new\n", 4, &error) == GOUGH_OK, "%s", error.message);
    expect_text(path, "new\n");
    ck_assert_int_eq(gough_write_file(path, "newer\n", 6, &error), GOUGH_OK);
    expect_text(path, "newer\n");
    ck_assert_int_eq(count_entries(folder), 1);

    /* as open to others as any new file of this user */
    struct stat about;
    const mode_t mask = umask(0);
    umask(mask);
    ck_assert_int_eq(stat(path, &about), 0);
    ck_assert_uint_eq(about.st_mode & 0777, 0666 & ~mask);
    remove_folder(folder);
}
END_TEST

START_TEST(a_missing_folder_is_named) {
    gough_error error = {.message = ""};
    ck_assert_int_eq(gough_write_file("no/such/folder/a.csv", "x", 1, &error), GOUGH_ERROR_FILE);
    ck_assert_msg(strstr(error.message, "the folder no/such/folder does not exist") != NULL, "%s",
                  error.message);
}
END_TEST

START_TEST(a_folder_is_no_file) {
    char folder[PATH_SIZE];
    make_folder(folder);
    gough_error error = {.message = ""};
    ck_assert_int_eq(gough_write_file(folder, "x", 1, &error), GOUGH_ERROR_FILE);
    ck_assert(strstr(error.message, "folder") != NULL);
    ck_assert_int_eq(gough_write_file("", "x", 1, &error), GOUGH_ERROR_FILE);
    remove_folder(folder);
}
END_TEST

/* /dev/full takes bytes and has no room for them; it must still be a device afterwards. */
START_TEST(a_full_device_is_an_error_and_stays_a_device) {
    char folder[PATH_SIZE];
    static const char *const names[] = {"full.csv", "full.h5"};
    make_folder(folder);
    for (int i = 0; i < 2; i++) {
        char path[PATH_SIZE];
        ck_assert_int_eq(symlink("/dev/full", path_in(folder, names[i], path)), 0);
        gough_study *study = study_by_hand("", false);
        gough_result *result = result_by_hand(study, "forces", 2000, &own_units);
        gough_error error = {.message = ""};
        ck_assert_int_eq(gough_result_write(result, path, &error), GOUGH_ERROR_FILE);
        ck_assert_msg(strstr(error.message, "No space left") != NULL, "%s", error.message);
        gough_result_free(result);
        free_study_by_hand(study);
    }
    struct stat about;
    ck_assert_int_eq(stat("/dev/full", &about), 0);
    ck_assert(S_ISCHR(about.st_mode));
    ck_assert_int_eq(count_entries(folder), 2);
    remove_folder(folder);
}
END_TEST

START_TEST(the_null_device_takes_anything_and_stays) {
    gough_error error = {.message = ""};
    ck_assert_msg(gough_write_file("/dev/null", "x", 1, &error) == GOUGH_OK, "%s", error.message);
    struct stat about;
    ck_assert_int_eq(stat("/dev/null", &about), 0);
    ck_assert(S_ISCHR(about.st_mode));
}
END_TEST

START_TEST(a_fifo_is_written_to) {
    char folder[PATH_SIZE], path[PATH_SIZE], got[16] = "";
    make_folder(folder);
    ck_assert_int_eq(mkfifo(path_in(folder, "fifo", path), 0600), 0);
    const pid_t writer = fork();
    if (writer == 0) _exit((int)gough_write_file(path, "through", 7, NULL));
    FILE *fifo = fopen(path, "r");
    ck_assert(fifo != NULL);
    ck_assert_uint_eq(fread(got, 1, sizeof got - 1, fifo), 7);
    fclose(fifo);
    ck_assert_str_eq(got, "through");
    int status = 1;
    waitpid(writer, &status, 0);
    ck_assert_int_eq(status, 0);
    remove_folder(folder);
}
END_TEST

START_TEST(a_link_stays_a_link) {
    char folder[PATH_SIZE], target[PATH_SIZE], link[PATH_SIZE];
    make_folder(folder);
    write_bytes(path_in(folder, "target", target), old_text, sizeof old_text - 1);
    chmod(target, 0640);
    ck_assert_int_eq(symlink("target", path_in(folder, "link", link)), 0);
    gough_error error = {.message = ""};
    ck_assert_msg(gough_write_file(link, "new\n", 4, &error) == GOUGH_OK, "%s", error.message);
    struct stat about;
    ck_assert_int_eq(lstat(link, &about), 0);
    ck_assert(S_ISLNK(about.st_mode));
    ck_assert_int_eq(stat(target, &about), 0);
    ck_assert_uint_eq(about.st_mode & 0777, 0640);
    expect_text(target, "new\n");
    remove_folder(folder);
}
END_TEST

/* A limit on the size of files stands for a disk that fills up half way. */
static void expect_full_disk(const char *name, bool existed) {
    char folder[PATH_SIZE], path[PATH_SIZE];
    make_folder(folder);
    path_in(folder, name, path);
    if (existed) write_bytes(path, old_text, sizeof old_text - 1);
    gough_study *study = study_by_hand("", false);
    gough_result *result = result_by_hand(study, "forces", 2000, &own_units);
    const pid_t writer = fork();
    if (writer == 0) {
        signal(SIGXFSZ, SIG_IGN);
        setrlimit(RLIMIT_FSIZE, &(struct rlimit){100000, 100000});
        gough_error error = {.message = ""};
        const gough_status status = gough_result_write(result, path, &error);
        _exit(status == GOUGH_ERROR_FILE && strstr(error.message, path) != NULL ? 0 : 1);
    }
    int status = 1;
    waitpid(writer, &status, 0);
    gough_result_free(result);
    free_study_by_hand(study);
    ck_assert_int_eq(status, 0);
    ck_assert_int_eq(count_entries(folder), existed ? 1 : 0);
    if (existed) expect_text(path, old_text);
    remove_folder(folder);
}

START_TEST(a_disk_that_fills_up_leaves_no_file) {
    expect_full_disk("a.csv", false);
    expect_full_disk("a.h5", false);
}
END_TEST

START_TEST(a_disk_that_fills_up_leaves_the_old_file) {
    expect_full_disk("a.csv", true);
    expect_full_disk("a.h5", true);
}
END_TEST

/* Without SIGXFSZ ignored the writer dies in the middle of its write, as one killed by hand does. */
START_TEST(a_killed_writer_leaves_nothing_under_the_final_name) {
    char folder[PATH_SIZE], path[PATH_SIZE];
    static const char *const names[] = {"a.csv", "a.h5"};
    make_folder(folder);
    gough_study *study = study_by_hand("", false);
    gough_result *result = result_by_hand(study, "forces", 2000, &own_units);
    for (int i = 0; i < 2; i++) {
        path_in(folder, names[i], path);
        const pid_t writer = fork();
        if (writer == 0) {
            signal(SIGXFSZ, SIG_DFL);
            setrlimit(RLIMIT_CORE, &(struct rlimit){0, 0});
            setrlimit(RLIMIT_FSIZE, &(struct rlimit){100000, 100000});
            gough_result_write(result, path, NULL);
            _exit(0);
        }
        int status = 0;
        waitpid(writer, &status, 0);
        ck_assert(WIFSIGNALED(status) && WTERMSIG(status) == SIGXFSZ);
        ck_assert(access(path, F_OK) != 0);
    }
    gough_result_free(result);
    free_study_by_hand(study);
    remove_folder(folder);
}
END_TEST

/* Standard output is a full device in the child. */
START_TEST(standard_output_is_checked) {
    static const struct {
        const char *target;
        gough_status status;
    } cases[] = {{"/dev/full", GOUGH_ERROR_FILE}, {"/dev/null", GOUGH_OK}};
    for (int i = 0; i < 2; i++) {
        fflush(stdout);
        const pid_t writer = fork();
        if (writer == 0) {
            const int target = open(cases[i].target, O_WRONLY);
            dup2(target, STDOUT_FILENO);
            _exit((int)gough_write_file("-", "x", 1, NULL));
        }
        int status = 0;
        waitpid(writer, &status, 0);
        ck_assert(WIFEXITED(status));
        ck_assert_int_eq(WEXITSTATUS(status), (int)cases[i].status);
    }
}
END_TEST

int main(void) {
    return SUITE_RUN(
        "table/output", 60, a_file_holds_what_was_written_and_nothing_stands_beside_it,
        a_missing_folder_is_named, a_folder_is_no_file,
        a_full_device_is_an_error_and_stays_a_device, the_null_device_takes_anything_and_stays,
        a_fifo_is_written_to, a_link_stays_a_link, a_disk_that_fills_up_leaves_no_file,
        a_disk_that_fills_up_leaves_the_old_file,
        a_killed_writer_leaves_nothing_under_the_final_name, standard_output_is_checked);
}
