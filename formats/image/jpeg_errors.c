#ifdef MESHTOOL_JPEG
#include "formats/image/jpeg_errors.h"

#include <jerror.h>

static void leave(j_common_ptr common)
{
    mt_jpeg_errors *errors = (mt_jpeg_errors *)(void *)common->err;
    if (errors->status == MT_OK) {
        errors->manager.format_message(common, errors->message);
        errors->status = errors->manager.msg_code == JERR_OUT_OF_MEMORY ? MT_ERROR_OUT_OF_MEMORY : MT_OK;
    }
    longjmp(errors->place, 1);
}

/* Warnings that leave pixels which the file does not hold. Others, such as bytes between markers, are harmless. */
static bool is_damage(int code)
{
    static const int codes[] = {JWRN_HIT_MARKER,     JWRN_JPEG_EOF,    JWRN_HUFF_BAD_CODE,
                                JWRN_ARITH_BAD_CODE, JWRN_MUST_RESYNC, JWRN_BOGUS_PROGRESSION};
    for (size_t i = 0; i < sizeof codes / sizeof codes[0]; i++) {
        if (codes[i] == code) {
            return true;
        }
    }
    return false;
}

static void hear(j_common_ptr common, int level)
{
    if (level < 0 && is_damage(common->err->msg_code)) {
        leave(common);
    }
}

static void say_nothing(j_common_ptr common)
{
    (void)common;
}

struct jpeg_error_mgr *mt_jpeg_errors_init(mt_jpeg_errors *errors)
{
    struct jpeg_error_mgr *manager = jpeg_std_error(&errors->manager);
    manager->error_exit = leave;
    manager->emit_message = hear;
    manager->output_message = say_nothing;
    errors->status = MT_OK;
    errors->message[0] = '\0';
    return manager;
}

void mt_jpeg_leave(mt_jpeg_errors *errors, mt_status status)
{
    errors->status = status;
    longjmp(errors->place, 1);
}
#endif
