// SPDX-License-Identifier: Apache-2.0
// usage: dxc.exe DXCOMPILER.DLL ROOT_SIGNATURE { PROFILE FILE }... : compiles each HLSL file with Direct3D's compiler and this root
// signature, a text, and prints a line "FILE: MESSAGE" for each that it refuses; else "FILE@i NAME INDEX MASK REGISTER" for each input, and with @o for each output. A
// Windows program, for Wine.
#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <windows.h>

// As dxcapi.h declares them, up to the last function that is called.
typedef struct {
    const void* data;
    size_t size;
    UINT encoding;
} Buffer;
typedef struct Object Object;
struct Object {
    void** calls; // QueryInterface, AddRef and Release are the first three
};
static const GUID kCompiler = {0x73e22d93, 0xe6ce, 0x47f3, {0xb5, 0xbf, 0xf0, 0x66, 0x4f, 0x39, 0xc1, 0xb0}};
static const GUID kCompiler3 = {0x228b4687, 0x5a6a, 0x4730, {0x90, 0x0c, 0x97, 0x02, 0xb2, 0x20, 0x3f, 0x54}};
static const GUID kResult = {0x58346cda, 0xdde7, 0x4497, {0x94, 0x61, 0x6f, 0x87, 0xaf, 0x5e, 0x06, 0x59}};
typedef HRESULT(__stdcall* Create)(const GUID* class_id, const GUID* interface_id, void** made);
typedef HRESULT(__stdcall* Compile)(Object*, const Buffer*, const wchar_t** arguments, UINT count, void* includes, const GUID*, void** result);
typedef HRESULT(__stdcall* GetStatus)(Object*, HRESULT*);
typedef HRESULT(__stdcall* GetBlob)(Object*, Object**);
typedef HRESULT(__stdcall* Disassemble)(Object*, const Buffer*, const GUID*, void** result);
typedef void*(__stdcall* GetData)(Object*);
typedef size_t(__stdcall* GetSize)(Object*);
typedef ULONG(__stdcall* Release)(Object*);

static const char* const kVague[] = {"error: validation errors", "error: Root Signature in DXIL container is not compatible with shader."};

static void release(Object* object)
{
    ((Release)object->calls[2])(object);
}

static Buffer readFile(const char* path)
{
    FILE* file = fopen(path, "rb");
    if (!file) {
        printf("%s: cannot be read\n", path);
        exit(2);
    }
    fseek(file, 0, SEEK_END);
    Buffer text = {0, (size_t)ftell(file), CP_UTF8};
    rewind(file);
    char* data = malloc(text.size);
    text.size = fread(data, 1, text.size, file);
    text.data = data;
    fclose(file);
    return text;
}

/// Prints the tables of inputs and outputs that a module's text has.
static void printSignatures(const char* path, const char* text)
{
    char kind = 0;
    for (const char* line = text; line && *line == ';'; line = strchr(line, '\n'), line += line != NULL) {
        char name[64];
        char mask[16];
        char place[16];
        unsigned index;
        if (strncmp(line, "; Input signature:", 18) == 0) {
            kind = 'i';
        } else if (strncmp(line, "; Output signature:", 19) == 0) {
            kind = 'o';
        } else if (strncmp(line, "; shader ", 9) == 0 || strncmp(line, "; Pipeline ", 11) == 0) {
            kind = 0;
        } else if (kind && sscanf(line, "; %63s %u %15s %15s", name, &index, mask, place) == 4) {
            printf("%s@%c %s %u %s %s\n", path, kind, name, index, mask, place);
        }
    }
}

/// The result's blob: 4: what was made, 5: the errors.
static Object* blobOf(Object* result, int which)
{
    Object* blob = NULL;
    return result && SUCCEEDED(((GetBlob)result->calls[which])(result, &blob)) ? blob : NULL;
}

static void disassemble(Object* compiler, Object* result, const char* path)
{
    Object* made = blobOf(result, 4);
    Object* text_result = NULL;
    const Buffer buffer = {((GetData)made->calls[3])(made), ((GetSize)made->calls[4])(made), 0};
    ((Disassemble)compiler->calls[4])(compiler, &buffer, &kResult, (void**)&text_result);
    Object* text = blobOf(text_result, 4);
    printSignatures(path, text ? ((GetData)text->calls[3])(text) : "");
    if (text) {
        release(text);
        release(text_result);
    }
    release(made);
}

static void compile(Object* compiler, const wchar_t* root_signature, const wchar_t* profile, const char* path)
{
    const Buffer text = readFile(path);
    const wchar_t* arguments[] = {L"-T", profile, L"-E", L"main", L"-D", root_signature, L"-rootsig-define", L"ROOT_SIGNATURE"};
    Object* result = NULL;
    HRESULT status = ((Compile)compiler->calls[3])(compiler, &text, arguments, sizeof(arguments) / sizeof(*arguments), NULL, &kResult, (void**)&result);
    if (SUCCEEDED(status)) {
        ((GetStatus)result->calls[3])(result, &status); // IDxcOperationResult: status, result, errors
    }
    if (SUCCEEDED(status)) {
        disassemble(compiler, result, path);
    } else {
        Object* errors = blobOf(result, 5);
        const char* message = errors ? ((GetData)errors->calls[3])(errors) : "cannot be compiled";
        for (int i = 0; i < 2; ++i) { // the next line says what
            const char* end = strchr(message, '\n');
            message = end && strncmp(message, kVague[i], strlen(kVague[i])) == 0 ? end + 1 : message;
        }
        printf("%s: %.*s\n", path, (int)strcspn(message, "\n"), message);
        if (errors) {
            release(errors);
        }
    }
    if (result) {
        release(result);
    }
    free((void*)text.data);
}

int main(int count, char** words)
{
    HMODULE library = count > 1 ? LoadLibraryA(words[1]) : NULL;
    Create create = library ? (Create)(void*)GetProcAddress(library, "DxcCreateInstance") : NULL;
    Object* compiler = NULL;
    if (!create || FAILED(create(&kCompiler, &kCompiler3, (void**)&compiler))) {
        printf("dxc: %s is no compiler\n", count > 1 ? words[1] : "nothing");
        return 2;
    }
    wchar_t root_signature[2048] = L"ROOT_SIGNATURE=";
    if (count > 2) {
        mbstowcs(root_signature + wcslen(root_signature), words[2], 2000);
    }
    for (int i = 3; i + 1 < count; i += 2) {
        wchar_t profile[16];
        mbstowcs(profile, words[i], 16);
        compile(compiler, root_signature, profile, words[i + 1]);
    }
    release(compiler);
    return 0;
}
