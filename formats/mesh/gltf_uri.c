/* Base64 (RFC 4648, section 4), and URIs of files beside (RFC 3986). */
#include "formats/mesh/gltf.h"

#include <string.h>

static int base64_value(char c)
{
    if (c >= 'A' && c <= 'Z') {
        return c - 'A';
    }
    if (c >= 'a' && c <= 'z') {
        return c - 'a' + 26;
    }
    if (c >= '0' && c <= '9') {
        return c - '0' + 52;
    }
    return c == '+' ? 62 : c == '/' ? 63 : -1;
}

size_t mt_base64_decode(const char *text, size_t size, uint8_t *out)
{
    size_t written = 0;
    if (size % 4 == 0 && size > 0 && text[size - 1] == '=') {
        size -= text[size - 2] == '=' ? 2 : 1;
    }
    for (size_t i = 0; i < size; i += 4) {
        size_t count = size - i < 4 ? size - i : 4;
        uint32_t bits = 0;
        for (size_t k = 0; k < count; k++) {
            int value = base64_value(text[i + k]);
            if (value < 0) {
                return SIZE_MAX;
            }
            bits |= (uint32_t)value << (18 - 6 * k);
        }
        if (count == 1) {
            return SIZE_MAX;
        }
        for (size_t k = 0; k + 1 < count; k++) {
            out[written++] = (uint8_t)(bits >> (16 - 8 * k));
        }
    }
    return written;
}

size_t mt_base64_encode(const uint8_t *bytes, size_t size, char *out)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    size_t written = 0;
    for (size_t i = 0; i < size; i += 3) {
        size_t count = size - i < 3 ? size - i : 3;
        uint32_t bits = (uint32_t)bytes[i] << 16;
        bits |= count > 1 ? (uint32_t)bytes[i + 1] << 8 : 0;
        bits |= count > 2 ? (uint32_t)bytes[i + 2] : 0;
        for (size_t k = 0; k < 4; k++) {
            out[written++] = k <= count ? digits[bits >> (18 - 6 * k) & 63] : '=';
        }
    }
    return written;
}

static int hex_value(char c)
{
    if (c >= '0' && c <= '9') {
        return c - '0';
    }
    c = (char)(c | 0x20);
    return c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
}

/* A part of the path of two dots. */
static bool climbs(const char *path)
{
    for (const char *at = path; at; at = strchr(at, '/')) {
        at += *at == '/';
        if (strncmp(at, "..", 2) == 0 && (at[2] == '/' || !at[2])) {
            return true;
        }
    }
    return false;
}

const char *mt_gltf_uri_path(const char *uri, char *path)
{
    size_t length = 0;
    if (strchr(uri, ':')) {
        return "has a scheme";
    }
    for (const char *at = uri; *at; at++) {
        path[length] = *at;
        if (*at == '%') {
            int high = hex_value(at[1]), low = high < 0 ? -1 : hex_value(at[2]);
            if (low < 0) {
                return "has a wrong percent code";
            }
            path[length] = (char)(16 * high + low);
            at += 2;
        }
        if (path[length] == '\0' || path[length] == '\\') {
            return "has a character that no file here may have";
        }
        length++;
    }
    path[length] = '\0';
    if (path[0] == '/') {
        return "is absolute";
    }
    if (climbs(path)) {
        return "climbs out of the folder";
    }
    return length == 0 || strchr(uri, '?') || strchr(uri, '#') ? "names no file" : NULL;
}
